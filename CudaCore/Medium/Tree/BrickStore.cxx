// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Tree/BrickStore.h"

#include "Medium/Samples/Prefilter.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace schlieren
{

namespace
{

/// Address space that is reserved at once; what is not used of it costs nothing, but with the address sanitizer, which
/// writes down for an eighth of it whose it is.
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t maxReserved = std::size_t{ 1 } << 22;
#else
constexpr std::size_t maxReserved = std::size_t{ 1 } << 30;
#endif

/// The numbers that are used, in this order, and then all others below `count`.
std::vector<std::int32_t> completed(std::vector<std::int32_t> used, std::size_t count)
{
  std::vector<bool> isUsed(count, false);
  for (const std::int32_t n : used)
  {
    isUsed[static_cast<std::size_t>(n)] = true;
  }
  for (std::size_t n = 0; n < count; ++n)
  {
    if (!isUsed[n])
    {
      used.push_back(static_cast<std::int32_t>(n));
    }
  }
  return used;
}

} // namespace

template <class Value>
BrickStore<Value>::BrickStore(const Layout& layout)
  : layout_(layout)
{
  clear();
}

template <class Value>
void BrickStore<Value>::clear()
{
  values_.assign(layout_.zeros * layout_.perBrick + layout_.behind, Value(0));
  free_.clear();
}

template <class Value>
Value* BrickStore<Value>::brick(std::int32_t number)
{
  return values_.data() + static_cast<std::size_t>(number) * layout_.perBrick;
}

template <class Value>
void BrickStore<Value>::reserve(std::size_t values)
{
  if (values <= values_.capacity())
  {
    return;
  }
  const std::size_t atOnce = std::min(layout_.usual, maxReserved) / sizeof(Value);
  try
  {
    values_.reserve(std::max({ values, atOnce, 2 * values_.size() }));
    requestHugePages(values_.data(), values_.capacity() * sizeof(Value));
  }
  catch (const std::bad_alloc&)
  {
    // What is needed now may be there all the same.
  }
}

template <class Value>
std::int32_t BrickStore<Value>::add(const std::vector<Value>& values)
{
  std::int32_t number;
  if (free_.empty())
  {
    const std::size_t needed = values_.size() + layout_.perBrick;
    reserve(needed);
    number = static_cast<std::int32_t>(count());
    values_.resize(needed - layout_.perBrick - layout_.behind);
    values_.insert(values_.end(), values.begin(), values.end());
    values_.resize(needed, Value(0));
    return number;
  }
  number = free_.back();
  free_.pop_back();
  std::copy(values.begin(), values.end(), brick(number));
  return number;
}

template <class Value>
void BrickStore<Value>::put(std::int32_t number, const char* values)
{
  const std::size_t needed =
    (static_cast<std::size_t>(number) + 1) * layout_.perBrick + layout_.behind;
  if (values_.size() < needed)
  {
    reserve(needed);
    values_.resize(needed);
  }
  std::memcpy(brick(number), values, bytesOfBrick());
}

/// Puts what is in place order[n] into place n.
template <class Value>
void BrickStore<Value>::permute(const std::vector<std::int32_t>& order)
{
  const std::size_t size = layout_.perBrick;
  std::vector<Value> first(size);
  std::vector<bool> isDone(order.size(), false);
  for (std::size_t n = 0; n < order.size(); ++n)
  {
    const auto start = static_cast<std::int32_t>(n);
    if (isDone[n] || order[n] == start)
    {
      continue;
    }
    std::copy_n(brick(start), size, first.begin());
    std::int32_t to = start;
    while (order[static_cast<std::size_t>(to)] != start)
    {
      const std::int32_t from = order[static_cast<std::size_t>(to)];
      std::copy_n(brick(from), size, brick(to));
      isDone[static_cast<std::size_t>(to)] = true;
      to = from;
    }
    std::copy_n(first.begin(), size, brick(to));
    isDone[static_cast<std::size_t>(to)] = true;
  }
}

template <class Value>
void BrickStore<Value>::arrange(const std::vector<std::int32_t>& bricks)
{
  permute(completed(bricks, count()));
  values_.resize(bricks.size() * layout_.perBrick);
  values_.resize(bricks.size() * layout_.perBrick + layout_.behind, Value(0));
  free_.clear();
}

template class BrickStore<float>;
template class BrickStore<double>;
template class BrickStore<std::int16_t>;

} // namespace schlieren
