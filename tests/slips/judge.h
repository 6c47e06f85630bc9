#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

// What `orb check` says of one mistake, judged by machine: is the line to write right?

namespace slips {

using Lines = std::vector<std::string>;

enum class Language { Basic, Structured, Macro, Test };
constexpr std::string_view endings[] = {"bas", "orb", "macro", "test"};

enum class Verdict {
  Good,   ///< the finding on its line offers a line, and with that the program means what was meant
  Named,  ///< a finding on its line, without the line to write
  Silent, ///< nothing is said, though the program does something else
  Wrong,  ///< the line that is offered means something else
};
constexpr std::size_t verdicts = 4;

struct Judged {
  Verdict verdict;
  std::string said; ///< the finding, for people
};

/// Judges a program with a mistake on line `at` (from 0); `meant` are programs as they may have
/// been meant. None of them: nobody can know, and a finding on the line is good.
Judged judge(Language language, const Lines& program, std::size_t at,
             const std::vector<Lines>& meant);

/// What a program does, as text that can be compared; empty where it has errors.
std::string meaning(Language language, const Lines& program);

std::string join(const Lines& lines);

} // namespace slips
