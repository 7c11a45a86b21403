// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSchlierenImageInformation.h"

#include "vtkSchlierenRepresentation.h"

#include "vtkCharArray.h"
#include "vtkClientServerStream.h"
#include "vtkCommunicator.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

namespace
{

constexpr int rgb = 3;

/// Returns one of the three channels of a grey image, and others as they are.
vtkSmartPointer<vtkUnsignedCharArray> withoutEqualChannels(vtkUnsignedCharArray* colors)
{
  const unsigned char* from = colors->GetPointer(0);
  const vtkIdType pixels = colors->GetNumberOfTuples();
  bool isGrey = colors->GetNumberOfComponents() == rgb;
  for (vtkIdType i = 0; isGrey && i < pixels; ++i)
  {
    isGrey = from[rgb * i] == from[rgb * i + 1] && from[rgb * i] == from[rgb * i + 2];
  }
  if (!isGrey)
  {
    return colors;
  }
  auto grey = vtkSmartPointer<vtkUnsignedCharArray>::New();
  grey->SetNumberOfValues(pixels);
  for (vtkIdType i = 0; i < pixels; ++i)
  {
    grey->SetValue(i, from[rgb * i]);
  }
  return grey;
}

/// Undoes withoutEqualChannels().
vtkSmartPointer<vtkUnsignedCharArray> withChannels(vtkUnsignedCharArray* colors)
{
  if (colors->GetNumberOfComponents() != 1)
  {
    return colors;
  }
  auto all = vtkSmartPointer<vtkUnsignedCharArray>::New();
  all->SetNumberOfComponents(rgb);
  all->SetNumberOfTuples(colors->GetNumberOfTuples());
  for (vtkIdType i = 0; i < all->GetNumberOfValues(); ++i)
  {
    all->SetValue(i, colors->GetValue(i / rgb));
  }
  return all;
}

} // namespace

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
  vtkNew<vtkCharArray> bytes;
  auto* colors = this->Image
    ? vtkUnsignedCharArray::SafeDownCast(this->Image->GetPointData()->GetScalars())
    : nullptr;
  if (colors)
  {
    vtkNew<vtkImageData> sent;
    sent->ShallowCopy(this->Image);
    sent->GetPointData()->SetScalars(withoutEqualChannels(colors));
    vtkCommunicator::MarshalDataObject(sent, bytes);
  }
  *stream << vtkClientServerStream::Reply
          << vtkClientServerStream::InsertArray(
               bytes->GetPointer(0), static_cast<int>(bytes->GetNumberOfValues()))
          << vtkClientServerStream::End;
}

//------------------------------------------------------------------------------
void vtkSchlierenImageInformation::CopyFromStream(const vtkClientServerStream* stream)
{
  this->Image = nullptr;
  vtkTypeUInt32 count = 0;
  vtkNew<vtkCharArray> bytes;
  if (!stream->GetArgumentLength(0, 0, &count) || count == 0)
  {
    return;
  }
  bytes->SetNumberOfValues(count);
  vtkSmartPointer<vtkDataObject> received;
  if (stream->GetArgument(0, 0, bytes->GetPointer(0), count))
  {
    received = vtkCommunicator::UnMarshalDataObject(bytes);
  }
  auto* image = vtkImageData::SafeDownCast(received);
  auto* colors =
    image ? vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars()) : nullptr;
  if (!colors)
  {
    vtkErrorMacro(<< "An image from the server is damaged, and not shown.");
    return;
  }
  image->GetPointData()->SetScalars(withChannels(colors));
  this->Image = image;
}
