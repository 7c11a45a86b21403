// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneBehind.h"

#include "vtkSchlierenActor.h"
#include "vtkSchlierenFilter.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPixelBufferObject.h"
#include "vtkPropCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"
#include "vtkTranslucentPass.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVolumetricPass.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace
{

constexpr int channels = 4; // of the framebuffer

/// Returns the smallest and the largest depth of a box.
std::pair<double, double> depthsOf(const double bounds[6], vtkCamera* camera)
{
  const double* eye = camera->GetPosition();
  const double* direction = camera->GetDirectionOfProjection();
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (int corner = 0; corner < 8; ++corner)
  {
    const double from[3] = { bounds[corner & 1] - eye[0], bounds[2 + (corner >> 1 & 1)] - eye[1],
      bounds[4 + (corner >> 2)] - eye[2] };
    const double depth = vtkMath::Dot(from, direction);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  return { nearest, farthest };
}

/// Sets another camera of a renderer during its lifetime.
class OtherCamera
{
public:
  OtherCamera(vtkRenderer* renderer, vtkCamera* camera)
    : Renderer(renderer)
    , Before(renderer->GetActiveCamera())
  {
    this->Renderer->SetActiveCamera(camera);
  }
  ~OtherCamera() { this->Renderer->SetActiveCamera(this->Before); }
  OtherCamera(const OtherCamera&) = delete;
  OtherCamera& operator=(const OtherCamera&) = delete;

private:
  vtkRenderer* Renderer;
  vtkSmartPointer<vtkCamera> Before;
};

/// Draws all tiles of a tiled window during its lifetime.
class AllTiles
{
public:
  explicit AllTiles(vtkRenderWindow* window)
    : Window(window)
  {
    std::copy_n(window->GetTileViewport(), 4, this->Before);
    this->Window->SetTileViewport(0, 0, 1, 1);
  }
  ~AllTiles() { this->Window->SetTileViewport(this->Before); }
  AllTiles(const AllTiles&) = delete;
  AllTiles& operator=(const AllTiles&) = delete;

private:
  vtkRenderWindow* Window;
  double Before[4];
};

vtkSmartPointer<vtkImageData> imageOf(vtkTextureObject* texture, const int size[2])
{
  const auto pixels = static_cast<vtkIdType>(size[0]) * size[1];
  std::vector<unsigned char> bytes(static_cast<std::size_t>(channels * pixels));
  auto buffer = vtkSmartPointer<vtkPixelBufferObject>::Take(texture->Download());
  unsigned int dimensions[2] = { static_cast<unsigned int>(size[0]),
    static_cast<unsigned int>(size[1]) };
  vtkIdType increments[2] = { 0, 0 };
  if (!buffer ||
    !buffer->Download2D(VTK_UNSIGNED_CHAR, bytes.data(), dimensions, channels, increments))
  {
    return nullptr;
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size[0], size[1], 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* rgb = static_cast<unsigned char*>(image->GetScalarPointer());
  for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(pixels); ++pixel)
  {
    std::copy_n(bytes.data() + channels * pixel, 3, rgb + 3 * pixel);
  }
  return image;
}

} // namespace

SceneBehind::SceneBehind(vtkRenderer* renderer)
  : Renderer(renderer)
{
  vtkPropCollection* props = renderer->GetViewProps();
  for (int i = 0; i < props->GetNumberOfItems(); ++i)
  {
    auto* prop = vtkProp::SafeDownCast(props->GetItemAsObject(i));
    if (prop->GetVisibility() && !vtkSchlierenActor::SafeDownCast(prop))
    {
      this->Props.push_back(prop);
    }
  }
}

vtkSmartPointer<vtkImageData> SceneBehind::Draw(
  vtkCamera* camera, const int size[2], double depth) const
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(this->Renderer->GetRenderWindow());
  if (!window)
  {
    return nullptr;
  }
  const double farthest = camera->GetClippingRange()[1];
  camera->SetClippingRange(std::min(depth, (1 - 1e-6) * farthest), farthest);
  const OtherCamera other(this->Renderer, camera);
  const AllTiles all(window);

  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  state->PushFramebufferBindings();
  vtkNew<vtkOpenGLFramebufferObject> buffer;
  buffer->SetContext(window);
  constexpr int depthBits = 24, samples = 0;
  vtkSmartPointer<vtkImageData> image;
  if (buffer->PopulateFramebuffer(
        size[0], size[1], true, 1, VTK_UNSIGNED_CHAR, true, depthBits, samples) &&
    buffer->StartNonOrtho(size[0], size[1]))
  {
    const auto useAll = [&]()
    {
      state->vtkglViewport(0, 0, size[0], size[1]);
      state->vtkglScissor(0, 0, size[0], size[1]);
    };
    useAll();
    this->Renderer->Clear();
    useAll();
    std::vector<vtkProp*> props = this->Props;
    vtkRenderState what(this->Renderer);
    what.SetFrameBuffer(buffer);
    what.SetPropArrayAndCount(props.data(), static_cast<int>(props.size()));
    vtkNew<vtkOpaquePass> opaque;
    vtkNew<vtkTranslucentPass> translucent;
    vtkNew<vtkVolumetricPass> volumetric;
    opaque->Render(&what);
    translucent->Render(&what);
    volumetric->Render(&what);
    image = imageOf(buffer->GetColorAttachmentAsTextureObject(0), size);
  }
  state->PopFramebufferBindings();
  return image;
}

double SceneBehind::GetDistance(double depth) const
{
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (vtkProp* prop : this->Props)
  {
    const double* bounds = prop->GetUseBounds() ? prop->GetBounds() : nullptr;
    if (!bounds || !vtkMath::AreBoundsInitialized(bounds))
    {
      continue;
    }
    const auto [begin, end] = depthsOf(bounds, this->Renderer->GetActiveCamera());
    if (end > depth)
    {
      nearest = std::min(nearest, std::max(begin, depth));
      farthest = std::max(farthest, end);
    }
  }
  return farthest > depth ? 0.5 * (nearest + farthest) - depth : -1;
}

double backOf(const double bounds[6], vtkCamera* camera) { return depthsOf(bounds, camera).second; }
