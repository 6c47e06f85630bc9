#include "compiler/messages/foreign.h"

#include "base/text.h"

#include <algorithm>
#include <array>

namespace orb::compiler {
namespace {

constexpr auto table = std::to_array<Foreign>({
#define ORB_FOREIGN(spelling, place, instead, help)                                                \
  {spelling, Foreign::Place::place, instead, help},
#include "compiler/messages/foreign.def"
});

} // namespace

std::span<const Foreign> foreign_words() {
  return table;
}

const Foreign* find_foreign(std::string_view spelling, Foreign::Place place) {
  const auto row = std::find_if(table.begin(), table.end(), [&](const Foreign& foreign) {
    return foreign.place == place && equal_words(spelling, foreign.spelling);
  });
  return row == table.end() ? nullptr : &*row;
}

} // namespace orb::compiler
