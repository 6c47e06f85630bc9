#pragma once

#include "compiler/analyse/flow.h"

#include <array>
#include <cstdint>
#include <vector>

namespace orb::compiler {

/// A place that assigns a letter.
struct Setting {
  std::uint32_t code = none;   ///< its line of code
  const Item* value = nullptr; ///< the value assigned by `let`; null for `for`, `read` and `input`
};

/// For each letter, the places that assign it, by kind and then in text order.
using Settings = std::array<std::vector<Setting>, most_letters>;

inline Settings read_settings(const Program& program, const Flow& flow) {
  using spec::Statement;
  Settings settings;
  for (const auto kind : {Statement::Let, Statement::For, Statement::Read, Statement::Input})
    for (const auto& place : flow.all(kind)) {
      const auto& statement = program.statements[place.statement];
      const auto* value =
          kind == Statement::Let ? &program.as<LetView>(statement).expression : nullptr;
      for (const auto& item : program.items_of(statement))
        if (item.kind == ItemKind::Letter)
          settings[item.value].push_back({place.code, value});
    }
  return settings;
}

} // namespace orb::compiler
