#include "repair/units.h"

#include "repair/word_index.h"

#include <array>
#include <string>

namespace orb::repair {
namespace {

struct CalledUnit {
  Unit unit;
  std::string_view words;
};

// `m` is a metre, or a minute among times.
constexpr auto called_units = std::to_array<CalledUnit>({
    {unit::ms,
     "ms msec millis millisec millisecond milliseconds millisekunden milisegundos millisecondes "
     "msecs millisecondi milissegundos milliseconde"},
    {unit::s, "s sec secs second seconds sekunde sekunden sek segundo segundos seconden seconde "
              "secondes secondi secondo seg"},
    {unit::min, "m min mins minute minutes minuten minuut minuto minutos minuti"},
    {unit::mm, "mm"},
    {unit::cm, "cm centimetre centimetres centimeter centimeters zentimeter centímetro "
               "centímetros centimetro centimetros centimètre centimètres centimetri"},
    {unit::m, "m metre metres meter meters mètre mètres metro metros metri"},
    {unit::dm, "dm decimetre decimeter dezimeter"},
    {unit::in, "in inch inches zoll"},
    {unit::ft, "ft foot feet"},
    {unit::yd, "yd yard yards"},
});

} // namespace

const Unit* unit_called(std::string_view word, Measure measure) {
  static const WordIndex index(called_units, [](const CalledUnit& one) { return one.words; });
  for (const auto at : index.lists_of(word))
    if (called_units[at].unit.measure == measure)
      return &called_units[at].unit;
  return nullptr;
}

std::int64_t milliseconds_of(std::string_view word) {
  const auto* const found = unit_called(word, Measure::Time);
  return found == nullptr ? 0 : found->steps / unit::ms.steps;
}

std::optional<std::int64_t> thousandths_in(std::string_view number) {
  const auto read =
      steps_of(number.starts_with('.') ? "0" + std::string(number) : std::string(number), 1000);
  return read && read->exact ? std::optional(read->count) : std::nullopt;
}

} // namespace orb::repair
