#include "base/slots.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb {

std::vector<std::string_view> Slot::choices() const {
  std::vector<std::string_view> all;
  for (auto rest = words; !rest.empty();) {
    const auto end = std::min(rest.find('|'), rest.size());
    all.push_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return all;
}

Message must_be(const Slot& slot) {
  const auto words = slot.choices();
  return !words.empty()      ? texts::MustBeEither(slot.name(), words.front(), words.back())
         : slot.is_limited() ? texts::MustBeRange(slot.name(), slot.least, slot.most)
                             : texts::MustBeNumber(slot.name());
}

std::string usage(const Slots& slots) {
  std::string all;
  for (const auto& slot : slots)
    all += fmt::format("{}{}{}{}{}{}{}", all.empty() ? "" : " ", slot.may_lack ? "[" : "",
                       slot.before, slot.before.empty() ? "" : " ", slot.shown,
                       slot.repeats ? " …" : "", slot.may_lack ? "]" : "");
  return all;
}

std::string usage(std::string_view word, const Slots& slots) {
  return fmt::format("{}{}{}", word, slots.empty() ? "" : " ", usage(slots));
}

} // namespace orb
