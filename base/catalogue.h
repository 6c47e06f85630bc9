#pragma once

#include "base/message.h"

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace orb {

/// What messages say to people in one of their languages. The keys are the English texts, with
/// their holes (base/texts.inc).
class Catalogue {
public:
  /// From JSON: objects with English keys and their translations. Nothing where it is not such.
  static std::optional<Catalogue> read(std::string_view json);
  /// The pseudo-locale of such a file: each text in English, between `⟦` and `⟧`.
  static std::optional<Catalogue> marked(std::string_view json);

  /// The message in that language; in English where the catalogue does not have its text, or one
  /// that is a part of it. Words as they are, such as the title of a test, are looked up as a
  /// whole.
  std::string say(const Message& message) const;

private:
  std::optional<std::string> find(const Message& message) const;

  std::unordered_map<std::string, std::string> texts_;
};

} // namespace orb
