#include "structured/text/numeral.h"

#include "base/text/text.h"
#include "base/units.h"

#include <array>

namespace orb::structured {
namespace {

constexpr std::array numeral_units{unit::ms, unit::s, unit::min};
constexpr std::int64_t most_numeral = 2147483648; // only after a minus sign, as the least number

} // namespace

Numeral read_numeral(std::string_view text) {
  const auto amount = split_amount(text);
  const auto* const unit = find_unit(lower(amount.rest), numeral_units);
  if (unit == nullptr) {
    const auto hex = hexadecimal(text);
    const auto value = hex ? hex : parse_number<std::int64_t>(text);
    if (!value || *value > (hex ? most_numeral - 1 : most_numeral))
      return {Numeral::Validity::Bad, false, 0};
    return {Numeral::Validity::Good, false,
            static_cast<std::int32_t>(static_cast<std::uint32_t>(*value))};
  }
  const auto time = steps_of(amount.number, unit->steps);
  if (!time || time->count >= most_numeral * unit::ms.steps)
    return {Numeral::Validity::Bad, true, 0};
  if (!time->exact || time->count % unit::ms.steps != 0)
    return {Numeral::Validity::Fraction, true, 0};
  return {Numeral::Validity::Good, true, static_cast<std::int32_t>(time->count / unit::ms.steps)};
}

} // namespace orb::structured
