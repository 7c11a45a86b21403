// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/RowShader.h"

#include <type_traits>
#include <variant>

namespace schlieren
{

namespace
{

template <int planes, class CutoffKind>
class ShaderOf : public RowShader<planes>
{
public:
  ShaderOf(
    const CutoffKind& cutoff, const Projection& projection, const Films& films, std::int64_t margin)
    : RowShader<planes>(films.planes[0].width() + 2 * margin, films.planes[0].height() + 2 * margin,
        std::is_same_v<CutoffKind, FringePhase>)
    , cutoff_(cutoff)
    , projection_(projection)
    , margin_(margin)
    , width_(static_cast<double>(films.planes[0].width()))
    , height_(static_cast<double>(films.planes[0].height()))
  {
  }

  RowRange shade(const TracedRays& pass, std::int64_t row, FilmRay<planes>* rays,
    RayCounts& counts) const override
  {
    const std::int64_t first = pass.rayOf(-margin_, row - margin_);
    const double startColumn = static_cast<double>(-margin_) + pass.pass.offset.column;
    const double startRow = static_cast<double>(row - margin_) + pass.pass.offset.row;
    const bool isRowOfImage = row >= margin_ && row < this->rows - margin_;
    RowRange lands;
    for (std::int64_t i = 0; i < this->columns; ++i)
    {
      const RayExit& exit = pass.exits[first + i];
      counts.add(exit);
      if (isRowOfImage && i >= margin_ && i < this->columns - margin_)
      {
        counts.addShaded(exit, cutoff_);
      }
      const FilmRay<planes> ray = schlieren::shade(
        exit, startColumn + static_cast<double>(i), startRow, pass.pass.tilt, projection_, cutoff_);
      rays[i] = ray;
      const double x = ray.x, y = ray.y;
      if (ray.arrives && x > -1 && x < width_ + 1 && y > -1 && y < height_ + 1)
      {
        lands.add(y);
      }
    }
    return lands;
  }

private:
  CutoffKind cutoff_;
  const Projection& projection_;
  std::int64_t margin_;
  double width_, height_;
};

} // namespace

template <int planes>
std::unique_ptr<const RowShader<planes>> rowShader(
  const Cutoffs& cutoff, const Projection& projection, const Films& films, std::int64_t margin)
{
  return std::visit(
    [&](const auto& kind) -> std::unique_ptr<const RowShader<planes>>
    {
      using Kind = std::decay_t<decltype(kind)>;
      if constexpr (planes == 1 && std::is_same_v<Kind, Interferogram>)
      {
        return std::make_unique<ShaderOf<planes, FringePhase>>(
          FringePhase{ kind }, projection, films, margin);
      }
      else if constexpr (planes == Kind::channels)
      {
        return std::make_unique<ShaderOf<planes, Kind>>(kind, projection, films, margin);
      }
      return nullptr;
    },
    cutoff);
}

template std::unique_ptr<const RowShader<1>> rowShader<1>(
  const Cutoffs&, const Projection&, const Films&, std::int64_t);
template std::unique_ptr<const RowShader<3>> rowShader<3>(
  const Cutoffs&, const Projection&, const Films&, std::int64_t);

} // namespace schlieren
