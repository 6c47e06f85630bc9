#pragma once

#include "base/diagnostic.h"
#include "base/message.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

// Judges by machine what `orb check` says about a mistake: is the offered line right?

namespace slips {

using Lines = std::vector<std::string>;

enum class Language { Basic, Structured, Macro, Test };
constexpr std::string_view endings[] = {"bas", "orb", "macro", "test"};

enum class Grade {
  Good,   ///< a finding on its line offers a line that restores the meaning
  Named,  ///< a finding on its line, without a line to write
  Silent, ///< no finding, although the program does something else
  Wrong,  ///< the offered line means something else
};
constexpr std::size_t grades = 4;

struct Judged {
  Grade grade;
  std::string said; ///< the finding as text

  /// True if the finding only says what the parser expected, the last resort.
  bool of_parser() const {
    return said.rfind("unexpected ", 0) == 0 || said.rfind("expected ", 0) == 0;
  }
};

/// Judges a program with a mistake on line `at` (from 0); `meant` lists the programs that the
/// author may have meant. If it is empty, any finding on the line counts.
Judged judge(Language language, const Lines& program, std::size_t at,
             const std::vector<Lines>& meant);

/// The same for a program with several mistakes of one kind: follows one finding after another, as
/// a patient beginner would.
Judged follow(Language language, const Lines& program, const std::vector<std::size_t>& at,
              const std::vector<Lines>& meant);

/// Returns the findings about a program, one a line.
Lines said_of(Language language, const Lines& program);

/// The same as messages: what was seen, what helps.
std::vector<orb::Message> messages_of(Language language, const Lines& program);

/// Returns all findings about a program.
std::vector<orb::Diagnostic> findings(Language language, const std::string& text);

/// Returns the effect of a program as comparable text; empty if it has errors.
std::string meaning(Language language, const Lines& program);

std::string join(const Lines& lines);
Lines split(const std::string& text);

} // namespace slips
