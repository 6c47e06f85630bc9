#pragma once

#include "structured/emit/letter_allocation.h"
#include "structured/lower/code.h"
#include "structured/text/program.h"

#include <cstdint>
#include <string>
#include <vector>

namespace orb::structured {

/// The numbering of the robot's lines.
struct Numbering {
  std::uint32_t start = 1;
  std::uint32_t step = 1;
};

/// A letter in a line of the robot and the source variable that it holds there.
struct NamedLetter {
  std::uint8_t letter = 0; ///< 0 for A
  std::uint32_t symbol = none;
};

/// A line of the robot and its origin.
struct RobotLine {
  std::uint32_t number = 0;
  std::uint32_t statement = 0;   ///< of the structured program
  std::uint32_t routine = 0;     ///< the enclosing sub; 0 is the main program
  std::uint32_t expansion = 0;   ///< in Code::expansions
  std::uint32_t offset = 0;      ///< into the text
  std::uint32_t names_begin = 0; ///< in RobotText::names
  std::uint32_t names_end = 0;
};

/// Plain orbBasic, one line per robot line.
struct RobotText {
  std::string text;
  std::vector<RobotLine> lines;
  std::vector<NamedLetter> names; ///< by line; temporaries have none
  bool numbers_suffice = true;    ///< false: beyond line 65535
};

/// Numbers the lines in order, so that each gets the shortest possible number, and prints them.
/// `lead` goes before each line: comments, or nothing.
class RobotComments {
public:
  virtual ~RobotComments() = default;
  virtual std::string before(const CodeLine& line) = 0;
};
RobotText print(const Program& program, const Code& code, const LetterAllocation& letters,
                Numbering numbering, RobotComments* comments = nullptr);

} // namespace orb::structured
