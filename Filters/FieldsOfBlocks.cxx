// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FieldsOfBlocks.h"

#include <cstddef>

namespace filters
{

namespace
{

/// Adds what each field says, with the field's number.
template <class Fields, class Write>
void putEach(Fields& fields, std::vector<char>& answer, const Write& write)
{
  for (std::size_t number = 0; number < fields.size(); ++number)
  {
    std::vector<char> ofField;
    write(fields[number], ofField);
    put(static_cast<std::uint64_t>(number), answer);
    putAll(ofField, answer);
  }
}

} // namespace

/// Reads what putEach() of several ranks has written.
void FieldsOfBlocks::forAnswers(
  Reader& request, const std::function<void(AmrField& field, Reader& answer)>& read)
{
  while (!request.IsAtEnd())
  {
    AmrField& field = this->fields.at(request.Get<std::uint64_t>());
    const auto ofField = request.GetAll<std::vector<char>>();
    Reader reader(ofField);
    read(field, reader);
  }
}

void FieldsOfBlocks::giveBlocks(Reader& request, std::vector<char>& answer)
{
  const auto images = request.GetAll<std::vector<std::uint64_t>>();
  putEach(this->fields, answer,
    [&](AmrField& field, std::vector<char>& blocks) { field.putBlocks(images, blocks); });
}

void FieldsOfBlocks::takeBlocks(Reader& request)
{
  this->forAnswers(request, [](AmrField& field, Reader& blocks) { field.addBlocks(blocks); });
}

void FieldsOfBlocks::renumber(Reader& request)
{
  const auto numbers = request.GetAll<std::vector<std::uint64_t>>();
  this->firstImages = request.GetAll<std::vector<std::uint64_t>>();
  for (AmrField& field : this->fields)
  {
    field.renumber(numbers);
  }
}

void FieldsOfBlocks::giveCellsAround(Reader& request, std::vector<char>& answer) const
{
  const auto rank = request.Get<std::uint64_t>();
  const std::uint64_t first = this->firstImages.at(rank);
  const std::uint64_t images = this->firstImages.at(rank + 1) - first;
  putEach(this->fields, answer,
    [&](const AmrField& field, std::vector<char>& copies)
    { field.putCopies(first, images, copies); });
}

void FieldsOfBlocks::addCells(Reader& request)
{
  this->forAnswers(request, [](AmrField& field, Reader& copies) { field.addCopies(copies); });
  for (AmrField& field : this->fields)
  {
    field.sortBlocks();
  }
}

} // namespace filters
