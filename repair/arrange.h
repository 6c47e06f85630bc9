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

// The values of a command, in whatever order and form they were written, put into its documented
// order and units: units and names tell which is which.

namespace orb::repair {

/// The first three are bare numbers: of a channel of a colour, of a speed, of anything.
enum class Counts : std::uint8_t { Plain, Channel, Speed, Milliseconds, Degrees, Name };

/// What a command takes.
struct Operand {
  std::string_view name;
  Counts counts = Counts::Plain;
  std::int64_t least = 0;
  std::int64_t most = 0;
  bool optional = false;
  std::vector<std::string_view> words = {}; ///< that stand for values
  std::string_view usual = {};              ///< what is taken where it lacks; empty: nothing is
};

/// A number, in thousandths of its own unit; of times: of a millisecond, of angles: of a degree.
struct Quantity {
  static constexpr std::int64_t one = 1000;
  std::int64_t thousandths = 0;
  Measure measure = Measure::Number;
};

/// The names that stand for numbers.
using Quantities = std::map<std::string, Quantity, std::less<>>;

struct Arranged {
  std::vector<std::string> values; ///< one for each operand; empty for those that are left out
  std::vector<bool> named;         ///< of which the name was said
  std::string wait;                ///< a time that no operand takes; empty without one
  bool sure = true;
};

/// The values of a command in their order; nothing where they do not tell what they are.
std::optional<Arranged> arrange(const Tokens& values, const std::vector<Operand>& operands,
                                const Quantities& known);

/// What an expression of numbers and known names comes to, as it is written: `kurz * 3` is `600ms`.
std::optional<std::string> compute(const Tokens& expression, const Quantities& known);

/// The number that the tokens are, with its unit.
std::optional<Quantity> quantity_of(const Tokens& tokens, const Quantities& known);

} // namespace orb::repair
