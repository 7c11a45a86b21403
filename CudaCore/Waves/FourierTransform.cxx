// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Waves/FourierTransform.h"

#include "Device/Parallel.h"

#include <unsupported/Eigen/FFT>

#include <algorithm>

namespace schlieren
{

namespace
{

using Value = ComplexField::Value;
using Transform = Eigen::FFT<double>;

constexpr std::int64_t linesInPiece = 32;
constexpr std::int64_t columnsAtOnce = 8; ///< two lines of a processor's cache

enum class Direction
{
  Forward,
  Backward
};

/// Transforms one line, with a factor of 1 / points on the way back.
void transformLine(
  Transform& transform, Direction direction, const Value* from, Value* to, std::int64_t points)
{
  if (points == 1)
  {
    *to = *from;
  }
  else if (direction == Direction::Forward)
  {
    transform.fwd(to, from, points);
  }
  else
  {
    transform.inv(to, from, points);
  }
}

bool transformRows(ComplexField& field, Direction direction, int threads, const Monitor& monitor)
{
  return parallelFor(
    field.rows, linesInPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      Transform transform;
      std::vector<Value> line(static_cast<std::size_t>(field.columns));
      for (std::int64_t row = begin; row < end; ++row)
      {
        Value* values = field.row(row);
        const auto isDark = [](const Value& value) { return value == Value(0); };
        if (!std::all_of(values, values + field.columns, isDark))
        {
          std::copy(values, values + field.columns, line.begin());
          transformLine(transform, direction, line.data(), values, field.columns);
        }
      }
    },
    monitor);
}

/// What happens to columns.
struct ColumnWork
{
  bool isForward;
  const SpectrumFilter* filter; ///< null: none
  bool isBackward;
};

/// Transforms columns begin ... end - 1, `columnsAtOnce` at most.
void transformColumns(ComplexField& field, std::int64_t begin, std::int64_t end,
  const ColumnWork& work, Transform& transform, std::vector<Value>& lines)
{
  const std::int64_t rows = field.rows;
  for (std::int64_t row = 0; row < rows; ++row)
  {
    for (std::int64_t column = begin; column < end; ++column)
    {
      lines[static_cast<std::size_t>((column - begin) * rows + row)] = field.row(row)[column];
    }
  }
  for (std::int64_t column = begin; column < end; ++column)
  {
    Value* line = lines.data() + (column - begin) * rows;
    Value* spectrum = lines.data() + columnsAtOnce * rows;
    if (work.isForward)
    {
      transformLine(transform, Direction::Forward, line, spectrum, rows);
      std::copy(spectrum, spectrum + rows, line);
    }
    if (work.filter != nullptr)
    {
      (*work.filter)(column, line);
    }
    if (work.isBackward)
    {
      transformLine(transform, Direction::Backward, line, spectrum, rows);
      std::copy(spectrum, spectrum + rows, line);
    }
  }
  for (std::int64_t row = 0; row < rows; ++row)
  {
    for (std::int64_t column = begin; column < end; ++column)
    {
      field.row(row)[column] = lines[static_cast<std::size_t>((column - begin) * rows + row)];
    }
  }
}

bool transformColumns(
  ComplexField& field, const ColumnWork& work, int threads, const Monitor& monitor)
{
  return parallelFor(
    field.columns, linesInPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      Transform transform;
      std::vector<Value> lines(static_cast<std::size_t>((columnsAtOnce + 1) * field.rows));
      for (std::int64_t column = begin; column < end; column += columnsAtOnce)
      {
        transformColumns(
          field, column, std::min(end, column + columnsAtOnce), work, transform, lines);
      }
    },
    monitor);
}

} // namespace

std::int64_t fastLength(std::int64_t points)
{
  const auto isFast = [](std::int64_t length)
  {
    for (const std::int64_t factor : { 2, 3, 5 })
    {
      while (length % factor == 0)
      {
        length /= factor;
      }
    }
    return length == 1;
  };
  std::int64_t length = std::max<std::int64_t>(points, 1);
  while (!isFast(length))
  {
    ++length;
  }
  return length;
}

double frequencyOf(std::int64_t index, std::int64_t points, double spacing)
{
  const std::int64_t number = 2 * index < points ? index : index - points;
  return static_cast<double>(number) / (static_cast<double>(points) * spacing);
}

bool makeSpectrum(ComplexField& field, int threads, const Monitor& monitor)
{
  return transformRows(field, Direction::Forward, threads, monitor) &&
    transformColumns(field, { true, nullptr, false }, threads, monitor);
}

bool makeField(
  ComplexField& spectrum, const SpectrumFilter& filter, int threads, const Monitor& monitor)
{
  return transformColumns(spectrum, { false, &filter, true }, threads, monitor) &&
    transformRows(spectrum, Direction::Backward, threads, monitor);
}

bool filterSpectrum(
  ComplexField& field, const SpectrumFilter& filter, int threads, const Monitor& monitor)
{
  return transformRows(field, Direction::Forward, threads, monitor) &&
    transformColumns(field, { true, &filter, true }, threads, monitor) &&
    transformRows(field, Direction::Backward, threads, monitor);
}

} // namespace schlieren
