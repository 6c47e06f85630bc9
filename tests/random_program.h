#pragma once

#include "base/random.h"
#include "spec/basic.h"

#include <algorithm>
#include <string>
#include <vector>

namespace orb::testing {

/// Writes random orbBasic programs, the same for the same seed: every statement, odd spellings,
/// mostly valid jumps, values often at the limits of their ranges.
class RandomProgram {
public:
  struct Style {
    int lines = 20;
    double broken = 0.0;     ///< share of lines that may not parse
    double wild_jump = 0.02; ///< share of jumps to a line that does not exist
    double odd_blanks = 0.2; ///< share of places with more or fewer blanks than usual
    double comments = 0.05;
  };

  RandomProgram(std::uint64_t seed, Style style) : random_{seed}, style_(style) {}

  std::string write() {
    std::string out;
    for (int i = 0; i < style_.lines; ++i) {
      out += blanks("") + std::to_string(number(i)) + blanks(" ", " ");
      out += random_.chance(style_.broken) ? broken() : statement(false);
      if (random_.chance(style_.comments))
        out += " 'note " + std::to_string(i);
      out += '\n';
    }
    return out;
  }

private:
  template <typename T>
  const T& pick(const std::vector<T>& from) {
    return from[random_.below(from.size())];
  }
  int upto(int n) { return static_cast<int>(random_.below(static_cast<std::uint64_t>(n))); }

  static int number(int index) { return 10 * (index + 1); }

  std::string target() {
    if (random_.chance(style_.wild_jump))
      return std::to_string(5 + 10 * upto(99));
    return std::to_string(number(upto(style_.lines)));
  }

  /// Returns `usual` blanks, or another number if allowed; at least `least`.
  std::string blanks(const std::string& usual, const std::string& least = "") {
    if (!random_.chance(style_.odd_blanks))
      return usual;
    return random_.chance(0.5) ? least : usual + (random_.chance(0.2) ? "\t" : "  ");
  }

  /// Returns a word with the blanks that separate it from letters.
  std::string word(const std::string& text) { return text + " " + blanks(""); }

  std::string comma() { return blanks("") + "," + blanks(""); }

  std::string letter() {
    static const std::string letters = "ABCDXYabYY";
    return std::string(1, letters[random_.below(letters.size())]);
  }

  std::string variable() { return random_.chance(0.06) ? "Z" : letter(); }

  std::string constant() {
    static const std::vector<std::string> edges = {
        "0",  "1",   "2",   "3",   "4",   "5",     "25",    "26",         "31", "32",
        "90", "255", "256", "359", "360", "65535", "65536", "2147483647", "007"};
    return random_.chance(0.7) ? std::to_string(upto(10)) : pick(edges);
  }

  std::string sensor() {
    const auto& row = spec::variables[random_.below(spec::variables.size())];
    return std::string(row.word);
  }

  std::string operand(int depth) {
    const int kind = upto(depth > 3 ? 6 : 10);
    if (kind < 3)
      return constant();
    if (kind < 5)
      return variable();
    if (kind == 5)
      return random_.chance(0.3) ? sensor() : letter();
    if (kind == 6)
      return word(std::string(spec::functions[random_.below(spec::functions.size())].word)) +
             expression(depth + 1);
    if (kind == 7 && random_.chance(0.4))
      return "-" + constant();
    return "(" + blanks("") + expression(depth + 1) + blanks("") + ")";
  }

  std::string expression(int depth = 0) {
    auto text = operand(depth);
    while (random_.chance(0.35)) {
      const char symbol = spec::operators[random_.below(spec::operators.size())].symbol;
      text += blanks(" ") + symbol + blanks(" ") + operand(depth);
    }
    return text;
  }

  /// Returns an expression that is mostly within 0 to 255.
  std::string small() {
    const int kind = upto(4);
    if (kind == 0)
      return constant();
    if (kind == 1)
      return "(" + expression(1) + ") & 255";
    return kind == 2 ? std::to_string(upto(256)) : letter();
  }

  std::string relation() {
    const char symbol = spec::relations[random_.below(spec::relations.size())].symbol;
    return expression() + blanks(" ") + symbol + blanks(" ") + expression();
  }

  std::string print_items() {
    std::string text;
    const int count = upto(4);
    for (int i = 0; i < count; ++i) {
      const int kind = upto(6);
      if (kind == 0)
        text += "\"it's \"";
      else if (kind == 1)
        text += blanks("") + "," + blanks(" ");
      else if (kind == 2)
        text += "$" + blanks("") + "(65 + " + letter() + " % 20)";
      else if (kind == 3 && i + 1 < count)
        text += ";";
      else
        text += " " + (random_.chance(0.2) ? "(" + expression(2) + ")" : expression(1)) + " ";
    }
    if (random_.chance(0.3))
      text += ";";
    return text;
  }

  std::string list(int count, std::string (RandomProgram::*make)()) {
    std::string text;
    for (int i = 0; i < count; ++i)
      text += (i == 0 ? "" : comma()) + (this->*make)();
    return text;
  }

  std::string simple() {
    switch (upto(22)) {
    case 0:
    case 1:
    case 2:
    case 3:
      return (random_.chance(0.1) ? "let " : "") + variable() + blanks(" ") + "=" + blanks(" ") +
             expression();
    case 4: return "Y = " + std::to_string(1 + upto(26));
    case 5:
    case 6: return (random_.chance(0.5) ? word("print") : "?" + blanks(" ")) + print_items();
    case 7: return word("goto") + target();
    case 8: return word("gosub") + target();
    case 9: return "return";
    case 10:
      return word("on") + "1 + " + letter() + " % 3 " + (random_.chance(0.5) ? "goto " : "gosub ") +
             list(1 + upto(3), &RandomProgram::target);
    case 11: return word("RGB") + list(3, &RandomProgram::small);
    case 12: return word("LEDC") + std::to_string(upto(10));
    case 13:
      return word("goroll") + small() + comma() + small() +
             (random_.chance(0.8) ? comma() + std::to_string(upto(4)) : "");
    case 14: return word("delay") + small();
    case 15: return word("data") + list(1 + upto(4), &RandomProgram::constant);
    case 16: return word("read") + list(1 + upto(2), &RandomProgram::variable);
    case 17: return "rstr";
    case 18: return word("backLED") + small();
    case 19: return random_.chance(0.5) ? "tron" : "troff";
    case 20:
      return word("timer" + std::string(1, static_cast<char>('A' + upto(3)))) + "= " + small();
    default: return "ctrl = " + small();
    }
  }

  std::string statement(bool in_branch) {
    if (!in_branch) {
      switch (upto(12)) {
      case 0:
      case 1: {
        std::string text = word("if") + relation();
        if (random_.chance(0.3))
          text += random_.chance(0.5) ? " and " + relation() : " or " + relation();
        text += " then " + statement(true);
        if (random_.chance(0.4))
          text += " else " + statement(true);
        return text;
      }
      case 2: {
        auto text = word("for") + variable() + " = " + small() + " to " + small();
        if (random_.chance(0.3))
          text +=
              std::string(" step ") + (random_.chance(0.3) ? "-" : "") + std::to_string(upto(4));
        return text;
      }
      case 3: return word("next") + variable();
      case 4: return rare();
      default: break;
      }
    }
    return simple();
  }

  std::string rare() {
    switch (upto(12)) {
    case 0: return "end";
    case 1: return "random";
    case 2: return word("heading") + small();
    case 3: return "raw 1," + small() + ",2," + small();
    case 4: return word("locate") + expression() + comma() + small();
    case 5: return word("basflg") + std::to_string(upto(20));
    case 6: return word("macrun") + small();
    case 7: return "mackill";
    case 8: return word("input") + letter() + ",5," + small();
    case 9: return random_.chance(0.2) ? std::string("reset") : std::string("rstr");
    case 10: return random_.chance(0.2) ? "sleep 5,0," + target() : std::string("troff");
    default: return "delay 1";
    }
  }

  /// Returns a statement with a piece omitted, doubled or replaced; it may still parse.
  std::string broken() {
    auto text = statement(false);
    static const std::vector<std::string> pieces = {"<=",   "(", ")",    "\"",  "rgb", ",",
                                                    "then", "=", "else", "$",   "Z(",  "to",
                                                    ":",    ".", "'",    "\x80"};
    const auto at = random_.below(text.size() + 1);
    switch (upto(3)) {
    case 0: text.erase(at, 1 + random_.below(4)); break;
    case 1: text.insert(at, pick(pieces)); break;
    default: text.replace(at, 2, pick(pieces)); break;
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
  }

  Random random_;
  Style style_;
};

} // namespace orb::testing
