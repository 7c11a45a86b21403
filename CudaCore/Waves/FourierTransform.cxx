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

bool areDark(const Value* values, std::int64_t count)
{
  return std::all_of(values, values + count, [](const Value& value) { return value == Value(0); });
}

bool transformRows(ComplexField& field, Direction direction, const RowRange& rows, int threads,
  const Monitor& monitor)
{
  return parallelFor(
    rows.end - rows.begin, linesInPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      Transform transform;
      std::vector<Value> line(static_cast<std::size_t>(field.columns));
      for (std::int64_t row = rows.begin + begin; row < rows.begin + end; ++row)
      {
        Value* values = field.row(row);
        if (!areDark(values, field.columns))
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
  const SpectrumFilter& filter;
  bool isBackward;
  RowRange rows; ///< that are wanted of the result
};

/// Transforms columns begin ... end - 1, `columnsAtOnce` at most.
void transformColumns(const ComplexField& from, ComplexField& to, std::int64_t begin,
  std::int64_t end, const ColumnWork& work, Transform& transform, std::vector<Value>& lines)
{
  const std::int64_t rows = from.rows;
  for (std::int64_t row = 0; row < rows; ++row)
  {
    for (std::int64_t column = begin; column < end; ++column)
    {
      lines[static_cast<std::size_t>((column - begin) * rows + row)] = from.row(row)[column];
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
    work.filter(column, line);
    if (work.isBackward && !areDark(line, rows))
    {
      transformLine(transform, Direction::Backward, line, spectrum, rows);
      std::copy(spectrum, spectrum + rows, line);
    }
  }
  for (std::int64_t row = work.rows.begin; row < work.rows.end; ++row)
  {
    for (std::int64_t column = begin; column < end; ++column)
    {
      to.row(row)[column] = lines[static_cast<std::size_t>((column - begin) * rows + row)];
    }
  }
}

bool transformColumns(const ComplexField& from, ComplexField& to, const ColumnWork& work,
  int threads, const Monitor& monitor)
{
  return parallelFor(
    from.columns, linesInPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      Transform transform;
      std::vector<Value> lines(static_cast<std::size_t>((columnsAtOnce + 1) * from.rows));
      for (std::int64_t column = begin; column < end; column += columnsAtOnce)
      {
        transformColumns(
          from, to, column, std::min(end, column + columnsAtOnce), work, transform, lines);
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

bool makeSpectrum(
  ComplexField& field, const SpectrumFilter& filter, int threads, const Monitor& monitor)
{
  const RowRange all{ 0, field.rows };
  return transformRows(field, Direction::Forward, all, threads, monitor) &&
    transformColumns(field, field, { true, filter, false, all }, threads, monitor);
}

bool makeField(const ComplexField& spectrum, const SpectrumFilter& filter, ComplexField& field,
  const RowRange& rows, int threads, const Monitor& monitor)
{
  return transformColumns(spectrum, field, { false, filter, true, rows }, threads, monitor) &&
    transformRows(field, Direction::Backward, rows, threads, monitor);
}

bool filterSpectrum(
  ComplexField& field, const SpectrumFilter& filter, int threads, const Monitor& monitor)
{
  const RowRange all{ 0, field.rows };
  return transformRows(field, Direction::Forward, all, threads, monitor) &&
    transformColumns(field, field, { true, filter, true, all }, threads, monitor) &&
    transformRows(field, Direction::Backward, all, threads, monitor);
}

} // namespace schlieren
