#include "base/message.h"

namespace orb {

std::string in_english(const Message& message) {
  if (message.text() == nullptr)
    return message.words();
  const auto english = message.text()->english;
  return with_holes_filled(english, [&](std::string_view name) {
    return in_english(message.fillers()[place_of_hole(english, name)]);
  });
}

} // namespace orb
