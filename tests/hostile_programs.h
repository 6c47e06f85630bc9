#pragma once

#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <utility>

namespace orb::testing {

/// A program designed to be expensive to compile to machine code.
struct HostileProgram {
  std::string_view what;
  std::string text;
};

/// Returns as many lines of one form as fit into `size` bytes; {0} is the line's number, {1} the
/// number of a distant line, {2} some constant.
inline std::string filled_with(std::string_view line, std::size_t size) {
  std::string text;
  for (std::size_t number = 1;; ++number) {
    const auto next = fmt::format(fmt::runtime(line), number, 1 + number * 37 % 100,
                                  3 + number * 7919 % 100'000) +
                      '\n';
    if (text.size() + next.size() > size)
      return text;
    text += next;
  }
}

/// Each has the maximal length of a program.
inline auto hostile_programs(std::size_t size) {
  std::string sum = "1 A=B";
  while (sum.size() + 8 < size)
    sum += fmt::format("+B%{}", 3 + sum.size());
  std::string called;
  for (int line = 9001; line < 9014; ++line)
    called += fmt::format("{} A=A*3+B%7\n", line);
  called += "9014 return\n";
  return std::array{
      HostileProgram{"divisions", filled_with("{0} A=A*{2}+B/{2}", size)},
      HostileProgram{"divisions by variables", filled_with("{0} A=B/C+B%C", size)},
      HostileProgram{"jumps", filled_with("{0} goto {1}", size)},
      HostileProgram{"tests that jump", filled_with("{0} if A%2<B%3 then goto {1}", size)},
      HostileProgram{"calls", filled_with("{0} gosub {1}", size)},
      HostileProgram{"calls of 14 lines",
                     filled_with("{0} gosub 9001", size - called.size()) + called},
      HostileProgram{"returns", filled_with("{0} return", size)},
      HostileProgram{"loops", filled_with("{0} for A=B to C step D", size)},
      HostileProgram{"the shortest lines", filled_with("{0} A=Z", size)},
      HostileProgram{"one endless line", sum + '\n'},
  };
}

} // namespace orb::testing
