#pragma once

#include "base/message.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

// Whether what beginners are told is said in their language, too.

namespace slips {

/// Messages of findings in English, each with what it is made of, and how often each was said.
struct Heard {
  std::map<std::string, std::size_t> times;
  std::map<std::string, orb::Message> messages;
  void hear(const orb::Message& message);
};

/// What the answers say around the findings: how severe, how many, in how many files.
void hear_frame(Heard& heard);

struct Coverage {
  std::size_t said = 0;       ///< messages, counted as often as they were said
  std::size_t translated = 0; ///< of these, in every language
  std::string missing;        ///< the others, a line each
};

/// Says all that in each language of `translations`.
Coverage translate_all(const Heard& heard, const std::filesystem::path& translations);

} // namespace slips
