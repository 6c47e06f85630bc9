#pragma once

#include "base/units.h"
#include "repair/called.h"
#include "repair/tokens.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Puts the values of a command, given in any order and notation, into its documented order and
// units. Units and names identify them.

namespace orb::repair {

/// The kind of value. The first three are plain numbers: any number, a colour channel, a speed.
enum class Counts : std::uint8_t { Plain, Channel, Speed, Milliseconds, Degrees, Name };

/// An operand of a command.
struct Operand {
  std::string_view name;
  Counts counts = Counts::Plain;
  std::int64_t least = 0;
  std::int64_t most = 0;
  bool optional = false;
  std::vector<std::string_view> words = {}; ///< words for values
  std::string_view usual = {};              ///< the default; empty: there is none
};

/// A number, in thousandths of its base unit: milliseconds for times, degrees for angles.
struct Quantity {
  static constexpr std::int64_t one = 1000;
  std::int64_t thousandths = 0;
  Measure measure = Measure::Number;
};

/// Names of numbers.
using Quantities = std::map<std::string, Quantity, std::less<>>;

struct Arranged {
  std::vector<std::string> values; ///< one per operand; empty if omitted
  std::vector<bool> named;         ///< true if the name was given
  std::string wait;                ///< a time that no operand takes; empty if there is none
  bool sure = true;
};

/// Arranges the values of a command; nothing if they are ambiguous.
std::optional<Arranged> arrange(const Tokens& values, const std::vector<Operand>& operands,
                                const Quantities& known);

/// Evaluates an expression of numbers and known names: `kurz * 3` is `600ms`.
std::optional<std::string> compute(const Tokens& expression, const Quantities& known);

/// Parses tokens as a number with its unit.
std::optional<Quantity> quantity_of(const Tokens& tokens, const Quantities& known);

} // namespace orb::repair
