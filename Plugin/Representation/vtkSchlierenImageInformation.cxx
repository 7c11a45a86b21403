// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSchlierenImageInformation.h"

#include "vtkSchlierenRepresentation.h"

#include "vtkClientServerStream.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

vtkStandardNewMacro(vtkSchlierenImageInformation);

//------------------------------------------------------------------------------
vtkSchlierenImageInformation::vtkSchlierenImageInformation() { this->RootOnly = 1; }

//------------------------------------------------------------------------------
vtkSchlierenImageInformation::~vtkSchlierenImageInformation() = default;

//------------------------------------------------------------------------------
void vtkSchlierenImageInformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Image: " << this->Image << "\n";
}

//------------------------------------------------------------------------------
void vtkSchlierenImageInformation::CopyFromObject(vtkObject* object)
{
  auto* representation = vtkSchlierenRepresentation::SafeDownCast(object);
  this->Image = representation ? representation->GetTracedImage() : nullptr;
}

//------------------------------------------------------------------------------
void vtkSchlierenImageInformation::AddInformation(vtkPVInformation* other)
{
  auto* information = vtkSchlierenImageInformation::SafeDownCast(other);
  if (information && information->Image)
  {
    this->Image = information->Image;
  }
}

//------------------------------------------------------------------------------
void vtkSchlierenImageInformation::CopyToStream(vtkClientServerStream* stream)
{
  stream->Reset();
  auto* bytes = this->Image
    ? vtkUnsignedCharArray::SafeDownCast(this->Image->GetPointData()->GetScalars())
    : nullptr;
  *stream << vtkClientServerStream::Reply << (bytes ? 1 : 0);
  if (bytes)
  {
    // Sends one of the three equal bytes of a grey image.
    const unsigned char* rgb = bytes->GetPointer(0);
    const vtkIdType pixels = bytes->GetNumberOfTuples();
    bool isGrey = bytes->GetNumberOfComponents() == 3;
    for (vtkIdType i = 0; isGrey && i < pixels; ++i)
    {
      isGrey = rgb[3 * i] == rgb[3 * i + 1] && rgb[3 * i] == rgb[3 * i + 2];
    }
    vtkNew<vtkUnsignedCharArray> grey;
    for (vtkIdType i = 0; isGrey && i < pixels; ++i)
    {
      grey->InsertNextValue(rgb[3 * i]);
    }
    const auto* sent = isGrey ? grey.Get() : bytes;
    *stream << vtkClientServerStream::InsertArray(this->Image->GetDimensions(), 3)
            << vtkClientServerStream::InsertArray(this->Image->GetOrigin(), 3)
            << vtkClientServerStream::InsertArray(this->Image->GetSpacing(), 3)
            << vtkClientServerStream::InsertArray(
                 const_cast<vtkUnsignedCharArray*>(sent)->GetPointer(0),
                 static_cast<int>(sent->GetNumberOfValues()));
  }
  *stream << vtkClientServerStream::End;
}

//------------------------------------------------------------------------------
void vtkSchlierenImageInformation::CopyFromStream(const vtkClientServerStream* stream)
{
  this->Image = nullptr;
  int isThere = 0, size[3];
  double origin[3], spacing[3];
  vtkTypeUInt32 count = 0;
  if (!stream->GetArgument(0, 0, &isThere) || !isThere || !stream->GetArgument(0, 1, size, 3) ||
    !stream->GetArgument(0, 2, origin, 3) || !stream->GetArgument(0, 3, spacing, 3) ||
    !stream->GetArgumentLength(0, 4, &count))
  {
    return;
  }
  vtkNew<vtkUnsignedCharArray> sent;
  sent->SetNumberOfValues(count);
  const vtkIdType pixels = static_cast<vtkIdType>(size[0]) * size[1];
  const vtkIdType channels = pixels > 0 ? count / pixels : 0;
  if (channels < 1 || channels * pixels != static_cast<vtkIdType>(count) ||
    !stream->GetArgument(0, 4, sent->GetPointer(0), count))
  {
    vtkErrorMacro(<< "An image from the server is damaged, and not shown.");
    return;
  }
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(pixels);
  for (vtkIdType i = 0; i < pixels; ++i)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      colors->SetValue(
        3 * i + channel, sent->GetValue(channels * i + (channels < 3 ? 0 : channel)));
    }
  }
  this->Image = vtkSmartPointer<vtkImageData>::New();
  this->Image->SetDimensions(size);
  this->Image->SetOrigin(origin);
  this->Image->SetSpacing(spacing);
  this->Image->GetPointData()->SetScalars(colors);
}
