#pragma once

// What every table of rules needs (base/rules.inc makes one); nobody else has to include this.

#include "base/diagnostic.h"

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace orb {

/// Whether no two rules of a table share an id.
consteval bool ids_are_unique(std::span<const Rule> table) {
  for (std::size_t i = 0; i < table.size(); ++i)
    for (std::size_t j = i + 1; j < table.size(); ++j)
      if (table[i].id == table[j].id)
        return false;
  return true;
}

/// The id that a rule has now, of one that it had before; every other word is returned as it is.
constexpr std::string_view current_id(std::string_view id) {
  return id == "include-circle" ? "include-cycle" : id;
}

/// The rule of that id, or of that former id; or null.
constexpr const Rule* find_rule(std::span<const Rule> table, std::string_view id) {
  id = current_id(id);
  for (const auto& rule : table)
    if (rule.id == id)
      return &rule;
  return nullptr;
}

} // namespace orb
