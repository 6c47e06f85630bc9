#pragma once

// Support for base/rules.inc, which makes a table of rules. Include this only through it.

#include "base/diagnostic.h"

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace orb {

/// True if no two rules of a table share an id.
consteval bool ids_are_unique(std::span<const Rule> table) {
  for (std::size_t i = 0; i < table.size(); ++i)
    for (std::size_t j = i + 1; j < table.size(); ++j)
      if (table[i].id == table[j].id)
        return false;
  return true;
}

/// Maps a former rule id to the current one; returns any other word unchanged.
constexpr std::string_view current_id(std::string_view id) {
  return id == "include-circle" ? "include-cycle" : id;
}

/// Finds the rule by its current or former id; null if there is none.
constexpr const Rule* find_rule(std::span<const Rule> table, std::string_view id) {
  id = current_id(id);
  for (const auto& rule : table)
    if (rule.id == id)
      return &rule;
  return nullptr;
}

} // namespace orb
