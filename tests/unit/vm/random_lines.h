#pragma once

#include "base/random.h"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace orb::vm {

/// Writes random orbBasic programs; the text depends on the seed and on the compiler, which orders
/// the random draws in a sum. tests/random_program.h knows every statement and spelling; these
/// programs keep to what runs far.
class RandomLines {
public:
  explicit RandomLines(std::uint64_t seed) : random_{seed} {}

  std::string write() {
    const int lines = 3 + below(20);
    // Most programs may use Z and read data: early faults show little.
    std::string text;
    if (chance(85))
      text = "4 Y = " + std::to_string(1 + below(20)) + "\n5 data 7," + number() + ",3\n";
    last_ = lines * 10;
    for (int line = 1; line <= lines; ++line)
      text += std::to_string(line * 10) + " " + statement(line) + "\n";
    return text;
  }

private:
  int below(int limit) {
    return static_cast<int>(random_.below(static_cast<std::uint64_t>(limit)));
  }
  bool chance(int percent) { return below(100) < percent; }
  template <class T>
  T one_of(std::initializer_list<T> list) {
    return *(list.begin() + below(static_cast<int>(list.size())));
  }

  std::string letter() { return std::string(1, one_of({'A', 'B', 'C', 'D', 'X', 'Y'})); }
  std::string variable() { return chance(5) ? "Z" : letter(); }
  std::string number() {
    switch (below(12)) {
    case 0: return "0";
    case 1: return std::to_string(below(100000));
    case 2: return "2147483647";
    case 3: return std::to_string(below(26));
    default: return std::to_string(1 + below(9));
    }
  }
  std::string line_number() {
    return chance(96) ? std::to_string(10 * (1 + below(last_ / 10))) : "99999"; // a missing line
  }

  std::string leaf() {
    if (chance(45))
      return number();
    if (chance(6))
      return one_of<std::string>({"speed", "yaw", "cmdroll", "timerA", "timerB", "ctrl"});
    return variable();
  }
  std::string expression(int depth = 0) {
    const int kind = below(10);
    if (depth > 3 || kind < 4)
      return leaf();
    if (kind == 4)
      return "(" + expression(depth + 1) + ")";
    if (kind == 5 && chance(40))
      return one_of<std::string>({"abs ", "sqrt ", "rnd "}) + expression(depth + 1);
    if (kind == 6 && chance(20))
      return "-" + leaf();
    const auto op =
        one_of<std::string>({"+", "-", "*", "+", "-", "*", "/", "%", "&", "|", "{", "}"});
    auto right = expression(depth + 1);
    if ((op == "/" || op == "%") && chance(70))
      right = std::to_string(1 + below(12));
    if ((op == "{" || op == "}") && chance(90))
      right = std::to_string(below(8));
    return expression(depth + 1) + op + right;
  }
  std::string relation() {
    if (chance(15)) // of low bits
      return letter() + one_of<std::string>({"%2", "%8", "&6", "&B"}) +
             one_of<std::string>({"=0", "!0"});
    return (chance(50) ? leaf() : expression(2)) + one_of<std::string>({"=", "!", "<", ">"}) +
           (chance(70) ? leaf() : expression(2));
  }
  std::string simple() {
    switch (below(14)) {
    case 0: return "goto " + line_number();
    case 1: return "gosub " + line_number();
    case 2: return chance(20) ? "return" : "A = A + 1";
    case 3: return "print " + expression(2) + (chance(50) ? ";" : "");
    case 4: return "RGB " + std::to_string(below(256)) + "," + expression(3) + "&255,7";
    case 5:
      return "on " + leaf() + (chance(50) ? " goto " : " gosub ") + line_number() + "," +
             line_number();
    case 6: return chance(5) ? "frobnicate" : "rstr";
    default: return variable() + " = " + expression(1);
    }
  }
  std::string statement(int line) {
    switch (below(24)) {
    case 0:
      return "for " + begin_loop() + " = " + leaf() + " to " + leaf() +
             (chance(30) ? " step " + leaf() : "");
    case 1:
    case 2: return open_.empty() || chance(3) ? simple() : "next " + end_loop();
    case 3:
    case 4: return "if " + relation() + " then " + simple();
    case 5: return "if " + relation() + " then " + simple() + " else " + simple();
    case 6:
      return "if " + relation() + one_of<std::string>({" and ", " or "}) + relation() + " then " +
             simple() + (chance(40) ? " else " + simple() : "");
    case 7: { // both values of one variable
      const auto to = letter();
      return "if " + relation() + " then " + to + "=" + expression(2) + " else " + to + "=" +
             expression(2);
    }
    case 8:
      return "if " + leaf() + one_of<std::string>({"<", ">", "="}) + leaf() + " then goto " +
             line_number();
    case 9:
      return "Y = " + (chance(50) ? number() : leaf() + one_of<std::string>({"+", "-"}) + leaf());
    case 10: return variable() + " = Z";
    case 11: return "Z = " + leaf();
    case 12: return letter() + " = " + letter() + one_of<std::string>({" + ", " - "}) + leaf();
    case 13:
      return "print \"l" + std::to_string(line) + "\" " + expression(1) + "," + leaf() +
             (chance(50) ? ";" : "");
    case 14: return "data " + leaf() + "," + number() + "," + leaf();
    case 15: return "read " + variable() + (chance(30) ? "," + variable() : "");
    case 16:
      return one_of<std::string>({"timerA", "timerB", "timerC", "ctrl"}) + " = " +
             std::to_string(below(3000));
    case 17: return "delay " + std::to_string(below(400));
    case 18:
      return chance(15) ? one_of<std::string>({"tron", "troff", "random", "reset", "end"})
                        : "input " + variable() + "," + number() + "," + leaf();
    case 19: return "goroll " + std::to_string(below(366)) + "," + leaf() + "&127,1";
    default: return simple();
    }
  }

  std::string begin_loop() {
    open_.push_back(chance(5) ? "Z" : letter());
    return open_.back();
  }
  std::string end_loop() {
    const auto name = open_.back();
    if (chance(80))
      open_.pop_back();
    return name;
  }

  std::vector<std::string> open_; ///< variables of loops begun above
  Random random_;
  int last_ = 10;
};

} // namespace orb::vm
