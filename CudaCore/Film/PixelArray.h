// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace schlieren
{

/// Holds numbers for each pixel. It resembles std::vector, but does not write zeros before the first value, and hands its
/// memory on without a copy.
template <class Value>
class PixelArray
{
public:
  using value_type = Value;
  using iterator = Value*;
  using const_iterator = const Value*;

  PixelArray() = default;
  /// Holds no particular values.
  explicit PixelArray(std::size_t size)
    : values_(new Value[size])
    , size_(size)
  {
  }
  PixelArray(const PixelArray& other)
    : PixelArray(other.size_)
  {
    std::copy(other.begin(), other.end(), begin());
  }
  PixelArray(PixelArray&& other) noexcept
    : values_(std::move(other.values_))
    , size_(std::exchange(other.size_, 0))
  {
  }
  PixelArray& operator=(PixelArray other) noexcept
  {
    std::swap(values_, other.values_);
    std::swap(size_, other.size_);
    return *this;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  Value* data() { return values_.get(); }
  const Value* data() const { return values_.get(); }
  Value* begin() { return data(); }
  Value* end() { return data() + size_; }
  const Value* begin() const { return data(); }
  const Value* end() const { return data() + size_; }
  Value& operator[](std::size_t index) { return values_[index]; }
  const Value& operator[](std::size_t index) const { return values_[index]; }

  operator std::vector<Value>() const { return { begin(), end() }; }

  /// Gives the memory to the caller, who frees it with delete[].
  Value* release()
  {
    size_ = 0;
    return values_.release();
  }

private:
  std::unique_ptr<Value[]> values_;
  std::size_t size_ = 0;
};

template <class Value>
bool operator==(const PixelArray<Value>& a, const PixelArray<Value>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}
template <class Value>
bool operator!=(const PixelArray<Value>& a, const PixelArray<Value>& b)
{
  return !(a == b);
}

} // namespace schlieren
