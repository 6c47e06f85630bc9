#include "structured/rules.h"

#include "base/rules.h"

#include <array>
#include <cstddef>

namespace orb::structured::rules {
namespace {

enum class Index : std::size_t {
#define ORB_RULE(name, ...) name,
#include "structured/rules.def"
#undef ORB_RULE
};

constexpr auto table = std::to_array<Rule>({
#define ORB_RULE(name, id, severity, summary, explanation, bad, good)                              \
  {id, Severity::severity, summary, explanation, bad, good},
#include "structured/rules.def"
#undef ORB_RULE
});

static_assert(ids_are_unique(table));

} // namespace

#define ORB_RULE(name, ...) const Rule& name = table[static_cast<std::size_t>(Index::name)];
#include "structured/rules.def"
#undef ORB_RULE

std::span<const Rule> all() {
  return table;
}

const Rule* find(std::string_view id) {
  return find_rule(table, id);
}

} // namespace orb::structured::rules
