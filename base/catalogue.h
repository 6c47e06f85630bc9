#pragma once

#include "base/message.h"

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace orb {

/// Translations of messages into one language. The keys are the English texts with their holes
/// (base/texts.inc).
class Catalogue {
public:
  /// Reads JSON: objects that map English keys to translations. Returns nothing if the JSON is
  /// malformed.
  static std::optional<Catalogue> read(std::string_view json);
  /// Builds the pseudo-locale of such a file: each text in English, between `⟦` and `⟧`.
  static std::optional<Catalogue> marked(std::string_view json);

  /// The message in this language, or in English if its text or any nested text is missing. Literal
  /// words, such as the title of a test, are looked up whole.
  std::string say(const Message& message) const;

private:
  std::optional<std::string> find(const Message& message) const;

  std::unordered_map<std::string, std::string> texts_;
};

} // namespace orb
