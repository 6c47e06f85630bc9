#pragma once

#include "base/random.h"
#include "spec/basic.h"

#include <algorithm>
#include <string>
#include <vector>

namespace orb::testing {

/// Writes random structured programs, the same for the same seed: all statements and blocks, calls
/// with side effects inside expressions, values at the limits of their ranges. Most end. With
/// habits, half of each consists of common patterns: counting by hand, flags, chains of equal
/// tests, exchanged values, predicates. Short programs are a few such lines on values unknown at
/// compile time: nothing else keeps alive what a pass drops wrongly.
class RandomStructured {
public:
  enum class Style { Any, Habits, Short };
  explicit RandomStructured(std::uint64_t seed, Style style = Style::Any)
      : random_{seed}, style_(style) {}

  std::string write() {
    arrays_ = upto(3);
    subs_ = upto(3);
    functions_ = upto(3);
    out_ = "const k1 = 3\nconst k2 = -7\nconst pause = 20ms\n";
    for (int n = 0; n < arrays_; ++n)
      out_ += "array list" + std::to_string(n) + "[" + std::to_string(sizes[n]) + "]\n";
    out_ += "data 4, 1, -3, k1 * 2, 300\n";
    const bool is_short = style_ == Style::Short;
    crowd_ = !is_short && chance(0.1) ? 17 + upto(3) : 0;
    for (const char* name : names)
      if (is_short && chance(0.5))
        out_ += "input " + std::string(name) + ", 5ms, " + number() + "\n";
      else
        out_ += std::string(name) + " = " + number() + "\n";
    // Values unknown at compile time need letters: use almost all of them.
    for (int n = 0; n < crowd_; ++n)
      out_ += "input c" + std::to_string(n) + ", 5ms, " + number() + "\n";
    block(1, is_short ? 1 + upto(3) : 3 + upto(5));
    out_ += "print";
    for (const char* name : names)
      if (!is_short || chance(0.3))
        out_ += std::string(" ") + name + ",";
    for (int n = 0; n < crowd_; ++n)
      out_ += " c" + std::to_string(n);
    out_ += " 0\n";
    for (routine_ = 1; routine_ <= subs_ + functions_; ++routine_)
      routine();
    return out_;
  }

private:
  static constexpr const char* names[] = {"alpha", "b", "count", "d", "e1", "y"};
  static constexpr int sizes[] = {5, 9, 11};

  int upto(int n) { return static_cast<int>(random_.below(static_cast<std::uint64_t>(n))); }
  bool chance(double share) { return random_.chance(share); }

  // Routine n calls only those with a greater number, so nothing calls itself.
  bool is_function(int n) const { return n > subs_; }
  std::string name_of(int n) const { return (is_function(n) ? "f" : "s") + std::to_string(n); }
  static int parameters_of(int n) { return n % 3; }

  void routine() {
    const bool function = is_function(routine_);
    out_ += (function ? "function " : "sub ") + name_of(routine_);
    const int parameters = parameters_of(routine_);
    if (parameters > 0)
      out_ += parameters == 1 ? "(p)" : "(p, q)";
    out_ += chance(0.3) ? "\n  local v = " + expression(2) + "\n" : "\n  local v\n";
    loops_ = 0;
    if (function && style_ != Style::Any && chance(0.6))
      return chance(0.3) && parameters > 0 ? use_up() : answer();
    block(2, 1 + upto(3));
    if (function && chance(0.8))
      out_ += "  return " + expression(0) + "\n";
    out_ += function ? "end function\n" : "end sub\n";
  }

  std::string variable() {
    if (routine_ > 0 && chance(0.4)) {
      const int parameters = parameters_of(routine_);
      const int which = upto(parameters + 1);
      return which == 0 ? "v" : which == 1 ? "p" : "q";
    }
    if (crowd_ > 0 && chance(0.4))
      return "c" + std::to_string(upto(crowd_));
    return names[upto(6)];
  }

  std::string number() {
    static const std::vector<std::string> edges = {
        "0", "1", "2", "31", "255", "359", "360", "65535", "2147483647", "0x7F", "k1", "k2"};
    return chance(0.7) ? std::to_string(upto(12)) : edges[random_.below(edges.size())];
  }

  std::string arguments(int routine, int depth) {
    std::string text = "(";
    for (int n = 0; n < parameters_of(routine); ++n)
      text += (n > 0 ? ", " : "") + expression(depth + 1);
    return text + ")";
  }

  std::string operand(int depth) {
    const int kind = depth > 3 ? upto(5) : upto(15);
    if (kind < 2)
      return number();
    if (kind < 5)
      return variable();
    if (kind == 5) {
      static const std::vector<std::string> sensors = {"speed", "yaw", "dshake", "cmdroll", "xpos"};
      return sensors[random_.below(sensors.size())];
    }
    if (kind == 6 && arrays_ > 0)
      return element(depth);
    if (kind == 7 && functions_ > 0) {
      const int callee = subs_ + 1 + upto(functions_);
      if (callee > routine_)
        return name_of(callee) + arguments(callee, depth);
    }
    if (kind == 8)
      return (chance(0.5) ? "min(" : "max(") + expression(depth + 1) + ", " +
             expression(depth + 1) + ")";
    if (kind == 9)
      return "rnd(" + std::to_string(1 + upto(20)) + ")";
    if (kind == 10)
      return (chance(0.7) ? "abs(" : "sqrt(") + expression(depth + 1) + ")";
    if (kind == 11)
      return "-" + variable();
    return "(" + expression(depth + 1) + ")";
  }

  std::string element(int depth) {
    const int array = upto(arrays_);
    const std::string index = chance(0.5)   ? std::to_string(1 + upto(sizes[array]))
                              : chance(0.7) ? "abs(" + expression(depth + 2) + ") % " +
                                                  std::to_string(sizes[array]) + " + 1"
                                            : expression(depth + 1);
    return "list" + std::to_string(array) + "[" + index + "]";
  }

  /// Returns an operand in more parentheses than the robot follows.
  std::string nest() {
    auto text = variable();
    for (int levels = 3 + upto(6); levels > 0; --levels) {
      const int kind = upto(6);
      const auto other = chance(0.5) ? number() : variable();
      text = kind == 0   ? "(" + other + " - " + text + ")"
             : kind == 1 ? "abs(" + text + " - " + other + ")"
             : kind == 2 ? "(" + text + " + " + other + ") * 2"
             : kind == 3 ? "(" + other + " & (" + text + "))"
             : kind == 4 ? "max(" + text + ", " + other + ")"
                         : "(" + text + " % 7 + " + other + ")";
    }
    return text;
  }

  std::string expression(int depth) {
    auto text = chance(0.03) ? nest() : operand(depth);
    while (chance(0.4)) {
      static const std::string often = "+-*&|+-";
      const auto& row = spec::operators[random_.below(spec::operators.size())];
      const char sign = chance(0.6) ? often[random_.below(often.size())] : row.symbol;
      text += std::string(" ") + sign + " " + operand(depth);
    }
    return text;
  }

  /// Returns an expression that is mostly within 0 to 255.
  std::string small() {
    const int kind = upto(4);
    if (kind == 0)
      return "(" + expression(2) + ") & 255";
    if (kind == 1)
      return "abs(" + variable() + ") % 200";
    return chance(0.95) ? std::to_string(upto(256)) : number();
  }

  /// Returns two tests of the same value, or of the maximum or minimum of two.
  std::string pair() {
    static const std::vector<std::string> signs = {"=", "<>", "<", ">", "<=", ">="};
    static const std::vector<std::string> sensors = {"speed", "yaw", "xpos", "accelX"};
    const auto value = chance(0.5) ? variable() : sensors[random_.below(sensors.size())];
    const auto limit = chance(0.7) ? number() : variable();
    const auto sign = [&] { return " " + signs[random_.below(signs.size())] + " "; };
    if (chance(0.3))
      return (chance(0.5) ? "min(" : "max(") + value + ", " + variable() + ")" + sign() + limit;
    return value + sign() + limit + (chance(0.5) ? " and " : " or ") + value + sign() +
           (chance(0.6) ? "-" : "") + limit;
  }

  std::string condition(int depth) {
    const int kind = upto(depth > 2 ? 3 : 6);
    static const std::vector<std::string> signs = {"=", "<>", "<", ">", "<=", ">=", "!"};
    if (chance(0.06))
      return pair();
    if (kind < 3)
      return expression(2) + " " + signs[random_.below(signs.size())] + " " + expression(2);
    if (kind == 3)
      return "not (" + condition(depth + 1) + ")";
    if (kind == 4)
      return condition(depth + 1) + (chance(0.5) ? " and " : " or ") + condition(depth + 1);
    return chance(0.5) ? "(" + condition(depth + 1) + ")" : expression(2);
  }

  void line(int depth, const std::string& text) {
    out_ += std::string(static_cast<std::size_t>(depth) * 2, ' ') + text + "\n";
  }

  void block(int depth, int statements) {
    for (int n = 0; n < statements; ++n)
      statement(depth);
  }

  std::string place(int depth) { return arrays_ > 0 && chance(0.25) ? element(depth) : variable(); }

  std::string simple() {
    switch (upto(14)) {
    case 0:
    case 1:
    case 2:
    case 3: return place(1) + " = " + expression(0);
    case 4: {
      static const std::vector<std::string> signs = {"+=", "-=", "*=", "+=", "%="};
      return place(1) + " " + signs[random_.below(signs.size())] + " " + expression(1);
    }
    case 5:
    case 6: return print();
    case 7: return "RGB " + small() + ", " + small() + ", " + small();
    case 8: return "goroll " + small() + ", " + small() + ", " + std::to_string(upto(3));
    case 9: return chance(0.5) ? "delay pause" : "delay " + small();
    case 10: return "read " + place(2);
    case 11: return chance(0.5) ? "rstr" : "RGB orange";
    case 12:
      if (subs_ > 0) {
        const int callee = 1 + upto(subs_);
        if (callee > routine_)
          return name_of(callee) + arguments(callee, 1);
      }
      return "backLED " + small();
    default:
      return chance(0.2) ? "heading " + small() : "input " + place(2) + ", 5ms, " + expression(1);
    }
  }

  std::string print() {
    std::string text = "print \"it is \" ";
    const int items = upto(5);
    for (int n = 0; n < items; ++n) {
      const int kind = upto(5);
      text += kind == 0   ? (chance(0.8) ? "\"some more text\" "
                                         : "\"a text that is longer than the robot prints\" ")
              : kind == 1 ? ", "
              : kind == 2 ? "$(65 + abs(" + variable() + ") % 20) "
                          : "(" + expression(1) + ") ";
    }
    if (text.back() == ' ' && text[text.size() - 2] == ',')
      text += "\"\"";
    return text + (chance(0.3) ? ";" : "");
  }

  std::string counter() { return own("i"); }

  /// Returns a unique name for the loop, or, in short programs, a common one.
  std::string own(const std::string& begin) {
    if (style_ == Style::Short && chance(0.4))
      return names[upto(2)];
    return begin + std::to_string(loops_) + "_" + std::to_string(routine_);
  }

  void statement(int depth) {
    if (style_ == Style::Short && depth < 5 && chance(0.4))
      return chance(0.5) ? follow_list(depth) : ask_between(depth);
    if (style_ != Style::Any && depth < 5 && chance(0.5))
      return habit(depth);
    const int kind = depth > 4 ? 24 : upto(24);
    switch (kind) {
    case 9: tower(depth); return;
    case 10: jumps(depth); return;
    case 11: endless(depth); return;
    case 0:
    case 1:
      line(depth,
           "if " + condition(0) + " then " + simple() + (chance(0.4) ? " else " + simple() : ""));
      return;
    case 2:
    case 3:
      line(depth, "if " + condition(0) + " then");
      block(depth + 1, upto(3));
      if (chance(0.3)) {
        line(depth, "elseif " + condition(1) + " then");
        block(depth + 1, 1 + upto(2));
      }
      if (chance(0.5)) {
        line(depth, "else");
        block(depth + 1, 1 + upto(2));
      }
      line(depth, "end if");
      return;
    case 4:
    case 5: for_loop(depth); return;
    case 6: {
      const auto times = chance(0.6) ? std::to_string(upto(4)) : small() + " % 4";
      line(depth, "repeat " + times);
      loop_body(depth);
      line(depth, "end repeat");
      return;
    }
    case 7: bounded_loop(depth); return;
    case 8: selection(depth); return;
    default:
      if (routine_ > 0 && chance(0.04))
        line(depth, is_function(routine_) ? "return " + expression(1) : "return");
      else if (chance(0.01))
        line(depth, "end");
      else
        line(depth, simple());
    }
  }

  void loop_body(int depth) {
    ++loops_;
    block(depth + 1, 1 + upto(2));
    if (chance(0.2))
      line(depth + 1, "if " + condition(1) + " then " + leaving());
    if (chance(0.5))
      block(depth + 1, 1);
    --loops_;
  }

  /// Writes nested loops, more than the robot can keep open.
  void tower(int depth) {
    if (tower_ || !chance(0.4))
      return line(depth, simple());
    tower_ = true;
    const int levels = 2 + upto(4);
    for (int n = 0; n < levels; ++n) {
      const auto name = "t" + std::to_string(n) + "_" + std::to_string(routine_);
      if (chance(0.7))
        line(depth + n, "for " + name + " = 1 to " + (chance(0.8) ? "2" : variable() + " & 1"));
      else
        line(depth + n, "repeat 2");
      towers_.push_back(out_.rfind("for ") > out_.rfind("repeat ") ? "next" : "end repeat");
    }
    line(depth + levels, simple());
    if (chance(0.3))
      line(depth + levels, "if " + condition(1) + " then " + leaving());
    for (int n = levels; n-- > 0;) {
      line(depth + n, towers_.back());
      towers_.pop_back();
      if (chance(0.3))
        line(depth + n, simple());
    }
    tower_ = false;
  }

  /// Returns a statement that leaves a loop or an iteration.
  std::string leaving() {
    if (routine_ > 0 && chance(0.3))
      return is_function(routine_) ? "return " + expression(1) : "return";
    return chance(0.5) ? "exit" : "continue";
  }

  /// Writes labels: a backward jump that is taken a few times, a jump out of a block.
  void jumps(int depth) {
    const auto name = "l" + std::to_string(labels_++);
    if (chance(0.5)) {
      line(depth, name + "n = 0");
      line(depth, name + ":");
      line(depth, name + "n += 1");
      block(depth + 1, 1 + upto(2));
      line(depth, "if " + name + "n < " + std::to_string(1 + upto(3)) + " then goto " + name);
      return;
    }
    const bool loop = chance(0.5);
    line(depth, loop ? "for " + name + "i = 1 to 3" : "if " + condition(1) + " then");
    line(depth + 1, simple());
    line(depth + 1, "if " + condition(1) + " then goto " + name);
    block(depth + 1, 1);
    line(depth, loop ? "next" : "end if");
    line(depth, simple());
    line(depth, name + ":");
  }

  void endless(int depth) {
    const auto name = own("n");
    line(depth, name + " = 0");
    line(depth, "loop");
    line(depth + 1, name + " += 1");
    line(depth + 1, "if " + name + " > " + std::to_string(upto(4)) + " then exit");
    loop_body(depth);
    line(depth, "end loop");
  }

  void for_loop(int depth) {
    const auto name = counter();
    static const std::vector<std::string> steps = {"", "", "", " step 2", " step -1", " step -3"};
    const auto step = steps[random_.below(steps.size())];
    const bool down = step.find('-') != std::string::npos;
    const auto low = chance(0.7) ? std::to_string(upto(5)) : variable() + " % 5";
    const auto high = chance(0.7) ? std::to_string(upto(7)) : variable() + " % 7";
    line(depth, "for " + name + " = " + (down ? high : low) + " to " + (down ? low : high) + step);
    if (chance(0.5))
      line(depth + 1, arrays_ > 0 && chance(0.6) ? "list0[" + name + "] = " + expression(1)
                                                 : "alpha += " + name);
    loop_body(depth);
    line(depth, "next" + (chance(0.5) ? " " + name : ""));
    if (chance(0.3))
      line(depth, "print \"after \" " + name);
  }

  /// Writes a `while` or `repeat … until` that counts.
  void bounded_loop(int depth) {
    const auto name = own("w");
    line(depth, name + " = " + std::to_string(upto(4)));
    const auto test = name + (chance(0.5) ? " < " : " <= ") + std::to_string(1 + upto(4));
    if (chance(0.5)) {
      line(depth, "while " + test + (chance(0.3) ? " and " + condition(1) : ""));
      line(depth + 1, name + " += 1");
      loop_body(depth);
      line(depth, "end while");
    } else {
      line(depth, "repeat");
      line(depth + 1, name + " += 1");
      loop_body(depth);
      line(depth, "until not (" + test + ")" + (chance(0.3) ? " or " + condition(1) : ""));
    }
  }

  void selection(int depth) {
    line(depth, "select " + (chance(0.5) ? "abs(" + expression(2) + ") % 6" : expression(1)));
    int value = 0;
    const int cases = 1 + upto(4);
    for (int n = 0; n < cases; ++n) {
      const int first = value + upto(2);
      const int last = first + (chance(0.3) ? 1 + upto(3) : 0);
      value = last + 1;
      auto text = "case " + std::to_string(first);
      if (last > first)
        text += " to " + std::to_string(last);
      if (chance(0.2))
        text += ", " + std::to_string(++value + 20);
      line(depth + 1, text);
      block(depth + 2, upto(2));
    }
    if (chance(0.5)) {
      line(depth + 1, chance(0.5) ? "else" : "case else");
      block(depth + 2, 1);
    }
    line(depth, "end select");
  }

  // ---- habits

  /// Writes a predicate.
  void answer() {
    if (chance(0.4)) {
      line(1, "for k" + std::to_string(routine_) + " = 2 to " + variable() + " % 6");
      line(2, "if " + condition(1) + " then return 0");
      line(1, "next");
    } else if (chance(0.3)) {
      block(1, 1);
    }
    if (chance(0.7)) {
      line(1, "if " + condition(1) + " then return 1");
      line(1, "return 0");
    } else {
      line(1, "if " + condition(1) + " then");
      line(2, "return 0");
      line(1, "else");
      line(2, "return 1");
      line(1, "end if");
    }
    out_ += "end function\n";
  }

  /// Writes a function that changes its parameters.
  void use_up() {
    line(1, "p = abs(p) % " + std::to_string(2 + upto(300)));
    if (chance(0.3))
      block(1, 1);
    line(1, "while p > 0");
    line(2, chance(0.7) ? "v += p % " + std::to_string(2 + upto(9)) : simple());
    if (chance(0.2))
      line(2, variable() + " += 1");
    line(2, chance(0.7) ? "p /= " + std::to_string(2 + upto(9)) : "p -= 40");
    line(1, "end while");
    line(1, chance(0.7) ? "return v" : "return v + " + variable());
    out_ += "end function\n";
  }

  void habit(int depth) {
    switch (upto(10)) {
    case 0: return exchange(depth);
    case 1: return count_by_hand(depth);
    case 2: return chain(depth);
    case 3: return alike(depth);
    case 4: return flag(depth);
    case 5: return ask(depth);
    case 6: return states(depth);
    case 7: return wait_for(depth);
    case 8: return ask_again(depth);
    default: return order(depth);
    }
  }

  void exchange(int depth) {
    if (arrays_ == 0)
      return line(depth, simple());
    const int array = upto(arrays_);
    const auto size = std::to_string(sizes[array]);
    const auto list = "list" + std::to_string(array);
    const auto name = "x" + std::to_string(loops_) + "_" + std::to_string(routine_);
    const bool loop = chance(0.4);
    std::string other = name + " + 1";
    const auto index = [&] {
      return chance(0.6) ? "rnd(" + size + ")" : "abs(" + variable() + ") % " + size + " + 1";
    };
    line(depth, "for q = 1 to " + size);
    line(depth + 1, list + "[q] = rnd(9)");
    line(depth, "next");
    if (loop)
      line(depth, "for " + name + " = 1 to " + size + " - 1");
    else
      line(depth, name + " = " + index());
    if (!loop || chance(0.4)) {
      other = name + "o";
      line(depth, other + " = " + index());
    }
    if (chance(0.7))
      line(depth, "if " + list + "[" + name + "] > " + list + "[" + other + "] then");
    else
      line(depth, "if " + condition(1) + " then");
    line(depth, "t = " + list + "[" + name + "]");
    line(depth, list + "[" + name + "] = " + list + "[" + other + "]");
    line(depth, list + "[" + other + "] = " + (chance(0.7) ? "t" : variable()));
    if (chance(0.3))
      line(depth, simple());
    line(depth, "end if");
    if (loop)
      line(depth, "next");
    line(depth, "print " + list + "[" + (loop ? "1" : name) + "]");
  }

  void count_by_hand(int depth) {
    const auto name = own("h");
    const bool down = chance(0.4);
    const auto step = std::to_string(1 + (chance(0.2) ? upto(3) : 0));
    const auto count = name + (down ? " -= " : " += ") + step;
    const auto end = chance(0.5)   ? std::to_string(upto(6))
                     : chance(0.5) ? variable() + " % 6"
                                   : (chance(0.5) ? std::string("alpha") : std::string("count"));
    line(depth, name + " = " + (down ? std::to_string(3 + upto(6)) : std::to_string(upto(3))));
    const auto within = name +
                        (down          ? chance(0.5) ? " > " : " >= "
                         : chance(0.5) ? " < "
                                       : " <= ") +
                        end;
    const bool first = chance(0.6);
    line(depth, first ? "while " + within : "repeat");
    if (chance(0.6)) {
      ++loops_;
      block(depth + 1, 1 + upto(2));
      --loops_;
    } else {
      line(depth + 1, "print " + name);
    }
    if (chance(0.1))
      line(depth + 1, "if " + condition(1) + " then exit");
    line(depth + 1, count);
    line(depth, first ? "end while" : "until not " + within);
    if (chance(0.4))
      line(depth, "print \"then \" " + name);
  }

  void chain(int depth) {
    const auto value = variable();
    const int count = 2 + upto(3);
    for (int n = 0; n < count; ++n) {
      line(depth, (n > 0 ? "elseif " : "if ") + value +
                      (chance(0.7)   ? " = "
                       : chance(0.5) ? " < "
                                     : " > ") +
                      std::to_string(n * 2) + " then");
      line(depth + 1, chance(0.3) ? value + " = " + number() : simple());
    }
    if (chance(0.4)) {
      line(depth, "else");
      line(depth + 1, simple());
    }
    line(depth, "end if");
  }

  /// Writes two branches that begin and end with the same lines.
  void alike(int depth) {
    const auto head = simple();
    const auto tail = simple();
    line(depth, "if " + condition(0) + " then");
    line(depth + 1, head);
    line(depth + 1, simple());
    line(depth + 1, tail);
    line(depth, "else");
    line(depth + 1, chance(0.8) ? head : simple());
    if (chance(0.6))
      line(depth + 1, simple());
    line(depth + 1, chance(0.8) ? tail : simple());
    line(depth, "end if");
  }

  void flag(int depth) {
    const auto name = "g" + std::to_string(loops_) + "_" + std::to_string(routine_);
    line(depth, name + " = 0");
    line(depth, "if " + condition(1) + " then " + name + " = 1");
    if (chance(0.5))
      line(depth, simple());
    if (chance(0.3))
      line(depth, "if " + condition(1) + " then " + name + " = 1 - " + name);
    line(depth, "if " + name + (chance(0.5) ? " = 1 then" : " then"));
    block(depth + 1, 1 + upto(2));
    line(depth, "end if");
  }

  /// Writes a test of a function's result.
  void ask(int depth) {
    const int callee = subs_ + 1 + upto(std::max(functions_, 1));
    if (functions_ == 0 || callee <= routine_)
      return flag(depth);
    const auto call = [&] { return name_of(callee) + arguments(callee, 2); };
    const auto test = [&] {
      return chance(0.5) ? call() : call() + (chance(0.5) ? " = 1" : " = 0");
    };
    line(depth,
         "if " + test() + (chance(0.4) ? (chance(0.5) ? " and " : " or ") + test() : "") + " then");
    block(depth + 1, 1 + upto(2));
    if (chance(0.5)) {
      line(depth, "elseif " + test() + " then");
      line(depth + 1, simple());
    }
    line(depth, "end if");
  }

  /// Writes the same call twice.
  void ask_again(int depth) {
    const int callee = subs_ + 1 + upto(std::max(functions_, 1));
    if (functions_ == 0 || callee <= routine_)
      return wait_for(depth);
    auto call = name_of(callee) + arguments(callee, 2);
    if (chance(0.5)) {
      call = name_of(callee) + "(";
      for (int n = 0; n < parameters_of(callee); ++n)
        call += (n > 0 ? ", " : "") + variable();
      call += ")";
    }
    if (chance(0.3))
      line(depth, "input " + variable() + ", 5ms, " + number()); // unknown at compile time
    line(depth, variable() + " = " + call);
    if (chance(0.5))
      line(depth, simple());
    if (chance(0.3))
      line(depth, "if " + condition(1) + " then " + simple());
    line(depth, "print " + call + (chance(0.3) ? " - " + call : ""));
  }

  /// Writes a loop that waits for a condition for a limited time, and a test of the outcome.
  void wait_for(int depth) {
    const auto found = "q" + std::to_string(loops_) + "_" + std::to_string(routine_);
    const auto down = chance(0.3);
    line(depth, found + " = 0");
    line(depth,
         "for " + counter() + " = " +
             (down ? std::to_string(upto(6)) + " to 1 step -" + std::to_string(1 + upto(2))
                   : "1 to " + (chance(0.7) ? std::to_string(1 + upto(6)) : variable() + " % 5")));
    ++loops_;
    if (chance(0.6))
      line(depth + 1, simple());
    line(depth + 1, "if " + condition(0) + " then");
    line(depth + 2, found + " = 1");
    line(depth + 2, "exit");
    line(depth + 1, "end if");
    if (chance(0.5))
      line(depth + 1, simple());
    line(depth, "next");
    --loops_;
    line(depth, "if " + found + " = 1 then");
    block(depth + 1, 1 + upto(2));
    line(depth, "else");
    line(depth + 1, simple());
    line(depth, "end if");
  }

  void states(int depth) {
    const auto name = "m" + std::to_string(loops_) + "_" + std::to_string(routine_);
    line(depth, name + " = 0");
    line(depth, "repeat " + std::to_string(2 + upto(5)));
    line(depth + 1, "select " + name);
    for (int n = 0; n < 3; ++n) {
      line(depth + 1, "case " + std::to_string(n));
      line(depth + 2, simple());
      line(depth + 2, chance(0.5) ? name + " = " + std::to_string(upto(4))
                                  : "if " + condition(1) + " then " + name + " = " +
                                        std::to_string(upto(4)) + " else " + name + " = 0");
    }
    line(depth + 1, "end select");
    if (chance(0.5))
      line(depth + 1, simple());
    line(depth, "end repeat");
  }

  /// Writes several comparisons of the same two values.
  void order(int depth) {
    const auto a = variable();
    const auto b = variable();
    line(depth, "if " + a + " = " + b + " then");
    block(depth + 1, 1 + upto(2));
    line(depth, "elseif " + a + (chance(0.5) ? " < " : " > ") + b + " then");
    line(depth + 1, chance(0.5) ? a + " = " + b + " + 1" : simple());
    line(depth, "else");
    line(depth + 1, chance(0.5) ? b + " = " + a + " - 1" : simple());
    if (chance(0.5))
      line(depth + 1, simple());
    line(depth, "end if");
  }

  /// Writes reads of a linked list: an element is the index of the next.
  void follow_list(int depth) {
    if (arrays_ == 0)
      return order(depth);
    const int array = upto(arrays_);
    const auto list = "list" + std::to_string(array);
    const auto name = variable();
    line(depth, "input " + name + ", 5ms, " + std::to_string(1 + upto(sizes[array])));
    for (int n = upto(3); n > 0; --n)
      line(depth, list + "[" + (chance(0.5) ? name : std::to_string(1 + upto(sizes[array]))) +
                      "] = " + (chance(0.7) ? std::to_string(1 + upto(sizes[array])) : small()));
    for (int n = 1 + upto(2); n > 0; --n)
      line(depth, (chance(0.7) ? name : variable()) + " = " + list + "[" + name +
                      (chance(0.2) ? " + 1" : "") + "]");
    for (int n = upto(3); n > 0; --n)
      line(depth, simple());
    line(depth, "print " + (chance(0.5) ? name : expression(1)));
  }

  /// Writes repeated comparisons whose result is known, with a call in between.
  void ask_between(int depth) {
    static const std::vector<std::string> signs = {" = ", " <> ", " < ", " > ", " <= ", " >= "};
    const auto a = variable();
    const auto b = variable();
    const auto test = [&] {
      const auto sign = signs[random_.below(signs.size())];
      return "if " + (chance(0.7) ? a + sign + b : b + sign + a) + " then";
    };
    const auto call = [&](int at) {
      const int callee = 1 + upto(std::max(subs_ + functions_, 1));
      if (callee <= routine_ || callee > subs_ + functions_)
        return line(at, simple());
      const auto given = name_of(callee) + arguments(callee, 3);
      line(at, is_function(callee) ? variable() + " = " + given : given);
    };
    line(depth, test());
    if (chance(0.5))
      call(depth + 1);
    line(depth + 1, test());
    call(depth + 1);
    if (chance(0.3)) {
      line(depth + 1, "else");
      call(depth + 1);
    }
    line(depth + 1, "end if");
    if (chance(0.3)) {
      line(depth, "else");
      call(depth + 1);
    }
    line(depth, "end if");
    if (chance(0.3))
      line(depth, test() + " " + simple());
  }

  Random random_;
  Style style_;
  std::string out_;
  int arrays_ = 0;
  int subs_ = 0;
  int functions_ = 0;
  int routine_ = 0; ///< 0 in the main program
  int loops_ = 0;
  int labels_ = 0;
  int crowd_ = 0;                   ///< variables in addition to the named ones
  bool tower_ = false;              ///< inside deeply nested loops
  std::vector<std::string> towers_; ///< the ends of those loops
};

} // namespace orb::testing
