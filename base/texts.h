#pragma once

#include "base/message.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

/// Messages shared by several modules, and the words around every finding: `texts::Write(line)`.
namespace orb::texts {

#define ORB_TEXTS "base/texts.def"
#include "base/texts.inc"

} // namespace orb::texts

namespace orb {

/// Finds the row, of `rows` or of these, for words of a table such as spec/. Names without a row
/// are the same in every language.
inline Message find_text(std::span<const Text* const> rows, std::string_view words) {
  for (const auto all : {rows, texts::all()})
    for (const auto* row : all)
      if (row->english == words)
        return {*row, {}};
  return Message::as_is(std::string(words));
}

/// Chooses singular or plural: `1 error`, `2 errors`.
inline Message counted(std::size_t n, const Row<>& one, const Row<Hole::Number>& several) {
  return n == 1 ? one() : several(n);
}

} // namespace orb
