#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

// Whether what beginners are told is said in their language, too.

namespace slips {

/// Sentences of findings, and how often each was said.
using Heard = std::map<std::string, std::size_t>;

/// What the answers say around the findings: how severe, how many, in how many files.
void hear_frame(Heard& heard);

/// The sentences in the transcripts of a folder, as `orb check` prints them.
void hear_transcripts(const std::filesystem::path& folder, Heard& heard);

struct Coverage {
  std::size_t said = 0;       ///< sentences, counted as often as they were said
  std::size_t translated = 0; ///< of these, in every language
  std::string missing;        ///< the others, a line each
  std::string troubles;       ///< translations that nobody needs
};

/// Says all that in each language of `translations`; what stands in `elsewhere` needs its
/// translation, too, but is not counted.
Coverage translate_all(const Heard& heard, const Heard& elsewhere,
                       const std::filesystem::path& translations);

} // namespace slips
