#pragma once

#include "base/diagnostic.h"
#include "base/message.h"

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

  /// Whether the finding is in the words of a parser, which are left when nothing else fits.
  bool of_parser() const {
    return said.rfind("unexpected ", 0) == 0 || said.rfind("expected ", 0) == 0;
  }
};

/// Judges a program with a mistake on line `at` (from 0); `meant` are programs as they may have
/// been meant. None of them: nobody can know, and a finding on the line is good.
Judged judge(Language language, const Lines& program, std::size_t at,
             const std::vector<Lines>& meant);

/// The same for a program with mistakes on several lines, all of one kind: it is followed, finding
/// after finding, as a patient beginner would.
Judged follow(Language language, const Lines& program, const std::vector<std::size_t>& at,
              const std::vector<Lines>& meant);

/// What is said of a program, a line for each finding.
Lines said_of(Language language, const Lines& program);

/// The same in its sentences: what was seen, what helps.
std::vector<orb::Message> messages_of(Language language, const Lines& program);

/// All findings about a program.
std::vector<orb::Diagnostic> findings(Language language, const std::string& text);

/// What a program does, as text that can be compared; empty where it has errors.
std::string meaning(Language language, const Lines& program);

std::string join(const Lines& lines);
Lines split(const std::string& text);

} // namespace slips
