#include "structured/emit/print.h"

#include "bytecode/arithmetic.h"
#include "spec/limits.h"
#include "structured/analyse/flow.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace orb::structured {
namespace {

using spec::Operator;

/// Tells if something follows within the same brackets, which a function would take as part of its
/// operand.
enum class After : std::uint8_t { Nothing, Something };

class Printer {
public:
  Printer(const Program& program, const Code& code, const LetterAllocation& letters,
          Numbering numbering)
      : program_(program), code_(code), letters_(letters), numbering_(numbering) {}

  RobotText run(RobotComments* comments) {
    number_labels();
    result_.text.reserve(code_.lines.size() * 24);
    std::uint32_t number = numbering_.start;
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto& line = code_.lines[i];
      if (line.kind == LineKind::Label || line.kind == LineKind::Nothing)
        continue;
      if (comments != nullptr)
        result_.text += comments->before(line);
      const auto names = static_cast<std::uint32_t>(result_.names.size());
      result_.lines.push_back({number, line.origin, line.routine, line.expansion,
                               static_cast<std::uint32_t>(result_.text.size()), names, names});
      put(number);
      put(' ');
      line_text(line);
      put('\n');
      result_.lines.back().names_end = static_cast<std::uint32_t>(result_.names.size());
      number += numbering_.step;
    }
    const auto most = static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestLineNumber));
    result_.numbers_suffice = result_.lines.empty() || result_.lines.back().number <= most;
    return std::move(result_);
  }

private:
  void number_labels() {
    numbers_.assign(code_.labels, 0);
    size_ = static_cast<std::uint32_t>(code_.lines.size());
    // Omit a final `end` that is not a jump target.
    if (size_ > 1 && ends_program(code_.lines[size_ - 1]) &&
        code_.lines[size_ - 2].kind != LineKind::Label)
      --size_;
    std::uint32_t number = numbering_.start;
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto& line = code_.lines[i];
      if (line.kind == LineKind::Label)
        numbers_[line.label] = number;
      else if (line.kind != LineKind::Nothing)
        number += numbering_.step;
    }
  }

  void put(char c) { result_.text += c; }
  void put(std::string_view text) { result_.text += text; }
  void put(std::int64_t value) {
    char digits[24];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    result_.text.append(digits, end);
  }
  void put(std::uint32_t value) { put(std::int64_t{value}); }
  void put_label(std::uint32_t label) { put(std::int64_t{numbers_[label]}); }
  void put_variable(std::uint32_t variable) {
    const auto letter = letters_.of[variable];
    put(spec::letter_name(letter == no_letter ? 0 : letter));
    if (const auto symbol = code_.variables[variable].symbol; symbol != none)
      result_.names.push_back({letter, symbol});
  }

  void line_text(const CodeLine& line) {
    switch (line.kind) {
    case LineKind::Nothing:
    case LineKind::Label:
    case LineKind::If:
    case LineKind::Switch: return;
    case LineKind::Let:
      put_variable(line.variable);
      put(" = ");
      whole(line.term);
      return;
    case LineKind::SetElement:
      put("Z = ");
      whole(line.term);
      return;
    case LineKind::SetSystem:
      put(spec::variables[line.variable].word);
      put(" = ");
      whole(line.term);
      return;
    case LineKind::Goto:
      put("goto ");
      put_label(line.label);
      return;
    case LineKind::For: loop(line); return;
    case LineKind::Next:
      put("next ");
      put_variable(line.variable);
      return;
    case LineKind::Gosub:
      put("gosub ");
      put_label(line.label);
      return;
    case LineKind::Return: put("return"); return;
    case LineKind::On: on(line); return;
    case LineKind::Print: print_line(line); return;
    case LineKind::Do: perform(line); return;
    case LineKind::Choice: choice(line); return;
    }
  }

  void loop(const CodeLine& line) {
    put("for ");
    put_variable(line.variable);
    put(" = ");
    whole(line.term);
    put(" to ");
    whole(line.end);
    if (line.step == 1)
      return;
    put(" step ");
    if (line.step == std::numeric_limits<std::int32_t>::min())
      put("0-2147483647-1");
    else
      put(std::int64_t{line.step});
  }

  void on(const CodeLine& line) {
    put("on ");
    whole(line.term);
    put(" goto ");
    for (auto i = line.parts_begin; i < line.parts_end; ++i) {
      if (i > line.parts_begin)
        put(',');
      put_label(code_.parts[i].value);
    }
  }

  void print_line(const CodeLine& line) {
    put("print");
    for (auto i = line.parts_begin; i < line.parts_end; ++i) {
      const auto& part = code_.parts[i];
      const bool sign = part.kind == PartKind::Blank || part.kind == PartKind::Open;
      if (!sign || i == line.parts_begin)
        put(' ');
      if (part.kind == PartKind::Term) {
        whole(part.value);
      } else if (part.kind == PartKind::Character) {
        put('$');
        whole(part.value);
      } else if (part.kind == PartKind::Text) {
        put('"');
        put(program_.text_of(part.text));
        put('"');
      } else {
        put(part.kind == PartKind::Blank ? ',' : ';');
      }
    }
  }

  void perform(const CodeLine& line) {
    put(spec::info(line.robot).word);
    for (auto i = line.parts_begin; i < line.parts_end; ++i) {
      const auto& part = code_.parts[i];
      put(i == line.parts_begin ? ' ' : ',');
      if (part.kind == PartKind::Variable)
        put_variable(part.value);
      else if (part.kind == PartKind::Element)
        put('Z');
      else if (part.kind == PartKind::Restart)
        put(numbering_.start);
      else
        whole(part.value);
    }
  }

  void choice(const CodeLine& line) {
    const auto& condition = code_.conditions[line.condition];
    put("if ");
    relation(condition.first);
    if (condition.glue != Glue::None) {
      put(condition.glue == Glue::And ? " and " : " or ");
      relation(condition.second);
    }
    put(" then ");
    line_text(code_.branches[line.term]);
    if (line.end == none)
      return;
    put(" else ");
    line_text(code_.branches[line.end]);
  }

  void relation(const Relation& relation) {
    const bool up = relation.comparison == Comparison::LessEqual;
    if (up || relation.comparison == Comparison::GreaterEqual) {
      const bool left = moved_side(code_, relation) == Moved::Left;
      side(relation.left, !left ? 0 : up ? -1 : 1);
      put(up ? " < " : " > ");
      side(relation.right, left ? 0 : up ? 1 : -1);
      return;
    }
    whole(relation.left);
    put(' ');
    put(spec::info(relation_of(relation.comparison)).symbol);
    put(' ');
    whole(relation.right);
  }

  /// Prints a term plus a number.
  void side(std::uint32_t term, std::int32_t added) {
    const auto& node = code_.terms[term];
    if (node.kind == TermKind::Number) {
      number(bytecode::add(node.value, added));
      return;
    }
    if (added == 0) {
      whole(term);
      return;
    }
    // x - 1 plus 1 is x
    if (node.kind == TermKind::Binary && code_.is_number(node.right)) {
      const auto op = static_cast<Operator>(node.what);
      const auto sign = op == Operator::Add ? 1 : -1;
      if ((op == Operator::Add || op == Operator::Subtract) &&
          code_.terms[node.right].value == -added * sign) {
        expression(node.left, After::Nothing);
        return;
      }
    }
    operand(term, Operator::Add, Side::Left, After::Something);
    put(added > 0 ? " + 1" : " - 1");
  }

  // ---- terms

  void whole(std::uint32_t term) { expression(term, After::Nothing); }

  void number(std::int32_t value) {
    if (value >= 0) {
      put(std::int64_t{value});
    } else if (value == std::numeric_limits<std::int32_t>::min()) {
      put("0-2147483647-1");
    } else {
      put("0-");
      put(-std::int64_t{value});
    }
  }

  void expression(std::uint32_t index, After after) {
    const auto& term = code_.terms[index];
    switch (term.kind) {
    case TermKind::Number: number(term.value); return;
    case TermKind::Variable: put_variable(term.left); return;
    case TermKind::Element: put('Z'); return;
    case TermKind::System: put(spec::variables[term.what].word); return;
    case TermKind::Call: {
      put(spec::functions[term.what].word);
      put(' ');
      const bool bracket = function_needs_parentheses(code_, term.left);
      if (bracket)
        put('(');
      expression(term.left, bracket ? After::Nothing : after);
      if (bracket)
        put(')');
      return;
    }
    case TermKind::Binary: {
      const auto op = static_cast<Operator>(term.what);
      operand(term.left, op, Side::Left, After::Something);
      put(' ');
      put(spec::info(op).symbol);
      put(' ');
      operand(term.right, op, Side::Right, after);
      return;
    }
    }
  }

  void operand(std::uint32_t index, Operator op, Side side, After after) {
    const auto& term = code_.terms[index];
    const bool bracket = needs_parentheses(term, op, side) ||
                         (ends_in_function(code_, index) && after == After::Something);
    if (bracket)
      put('(');
    expression(index, bracket ? After::Nothing : after);
    if (bracket)
      put(')');
  }

  const Program& program_;
  const Code& code_;
  const LetterAllocation& letters_;
  Numbering numbering_;
  RobotText result_;
  std::vector<std::uint32_t> numbers_; ///< of each label
  std::uint32_t size_ = 0;
};

} // namespace

RobotText print(const Program& program, const Code& code, const LetterAllocation& letters,
                Numbering numbering, RobotComments* comments) {
  return Printer(program, code, letters, numbering).run(comments);
}

} // namespace orb::structured
