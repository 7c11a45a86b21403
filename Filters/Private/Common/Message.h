// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads and writes values in messages between ranks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace filters
{

/// Appends plain values to a message.
template <class Value>
void put(const Value* values, std::size_t count, std::vector<char>& bytes)
{
  static_assert(std::is_trivially_copyable_v<Value>);
  const std::size_t at = bytes.size();
  bytes.resize(at + count * sizeof(Value));
  if (count > 0)
  {
    std::memcpy(bytes.data() + at, values, count * sizeof(Value));
  }
}
template <class Value>
void put(const Value& value, std::vector<char>& bytes)
{
  put(&value, 1, bytes);
}
/// Appends the size and the values of a vector or a string.
template <class Values>
void putAll(const Values& values, std::vector<char>& bytes)
{
  put(static_cast<std::uint64_t>(values.size()), bytes);
  put(values.data(), values.size(), bytes);
}

/// Reads what put() has written. Throws std::runtime_error at the end of the message.
class Reader
{
public:
  explicit Reader(const std::vector<char>& bytes)
    : Bytes(bytes)
  {
  }

  bool IsAtEnd() const { return this->At == this->Bytes.size(); }

  template <class Value>
  void Get(Value* values, std::size_t count)
  {
    if (count > (this->Bytes.size() - this->At) / sizeof(Value))
    {
      Fail();
    }
    if (count > 0)
    {
      std::memcpy(values, this->Bytes.data() + this->At, count * sizeof(Value));
      this->At += count * sizeof(Value);
    }
  }

  template <class Value>
  Value Get()
  {
    Value value;
    this->Get(&value, 1);
    return value;
  }
  /// Reads what putAll() has written.
  template <class Values>
  Values GetAll()
  {
    using Value = typename Values::value_type;
    const auto count = this->Get<std::uint64_t>();
    if (count > (this->Bytes.size() - this->At) / sizeof(Value))
    {
      this->Fail();
    }
    Values values(static_cast<std::size_t>(count), Value());
    this->Get(values.data(), values.size());
    return values;
  }

  /// Appends what putAll() has written to more of the same.
  template <class Values>
  void AddAll(Values& values)
  {
    const auto more = this->GetAll<Values>();
    values.insert(values.end(), more.begin(), more.end());
  }

  [[noreturn]] static void Fail()
  {
    throw std::runtime_error("What another rank has sent of its data cannot be read. Are all "
                             "ranks of the same version of this plugin?");
  }

private:
  const std::vector<char>& Bytes;
  std::size_t At = 0;
};

} // namespace filters
