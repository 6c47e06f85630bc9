#pragma once

#include "base/message.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

// Counts the messages to beginners that are translated.

namespace slips {

/// Messages of findings by their English, each with its parts and how often it was shown.
struct Heard {
  std::map<std::string, std::size_t> times;
  std::map<std::string, orb::Message> messages;
  void hear(const orb::Message& message);
};

/// Adds the texts around findings: severity, number, number of files.
void hear_frame(Heard& heard);

struct Coverage {
  std::size_t said = 0;       ///< messages, each as often as it was shown
  std::size_t translated = 0; ///< of these, translated into every language
  std::string missing;        ///< the others, one a line
};

/// Translates all messages to each language of `translations`.
Coverage translate_all(const Heard& heard, const std::filesystem::path& translations);

} // namespace slips
