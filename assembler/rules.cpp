#include "assembler/rules.h"

#include <array>
#include <cstddef>

namespace orb::assembler::rules {
namespace {

enum class Index : std::size_t {
#define ORB_RULE(name, ...) name,
#include "assembler/rules.def"
#undef ORB_RULE
};

constexpr auto table = std::to_array<Rule>({
#define ORB_RULE(name, id, severity, summary, explanation, bad, good)                              \
  {id, Severity::severity, summary, explanation, bad, good, 0},
#include "assembler/rules.def"
#undef ORB_RULE
});

consteval bool ids_are_unique() {
  for (std::size_t i = 0; i < table.size(); ++i)
    for (std::size_t j = i + 1; j < table.size(); ++j)
      if (table[i].id == table[j].id)
        return false;
  return true;
}
static_assert(ids_are_unique());

} // namespace

#define ORB_RULE(name, ...) const Rule& name = table[static_cast<std::size_t>(Index::name)];
#include "assembler/rules.def"
#undef ORB_RULE

std::span<const Rule> all() {
  return table;
}

const Rule* find(std::string_view id) {
  for (const auto& rule : table)
    if (rule.id == id)
      return &rule;
  return nullptr;
}

} // namespace orb::assembler::rules
