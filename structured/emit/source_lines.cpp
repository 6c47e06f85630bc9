#include "structured/emit/source_lines.h"

#include "bytecode/arithmetic.h"
#include "structured/analyse/flow.h"

#include <algorithm>
#include <optional>

namespace orb::structured {
namespace {

using spec::Operator;

/// Builds the program for the linter. Large because each kind of line, condition and item has its
/// own writer.
class SourceLines {
public:
  SourceLines(const Program& program, const Code& code)
      : program_(program), code_(code), number_of_(code.labels, none) {
    out_.text = program.text;
    find_letters();
  }

  compiler::Program run() {
    find_reached();
    for (std::size_t i = 0; i < code_.lines.size(); ++i)
      if (!reached_[i] && code_.lines[i].kind != LineKind::Label)
        continue; // a constant test skips it
      else if (goes_around_jump(i))
        write_jump(code_.lines[i], code_.lines[i + 1].label), ++i;
      else if (!is_idle(i))
        write(code_.lines[i]);
    for (auto& item : out_.items)
      if (item.kind == compiler::ItemKind::Target)
        item.value = number_of_[item.value];
    return std::move(out_);
  }

private:
  static constexpr std::uint32_t unknown = compiler::most_letters - 1; ///< set but never read

  /// Assigns letters in turn, with the robot's own for the index: first to loop counters, then to
  /// named variables. Variables beyond the limit are treated as unknown.
  void find_letters() {
    out_.letters = compiler::most_letters;
    letter_of_.resize(code_.variables.size(), unknown);
    letter_of_[index_variable] = compiler::index_letter;
    for (const auto& line : code_.lines)
      if (line.kind == LineKind::For)
        give_letter(line.variable);
    for (std::uint32_t v = 0; v < code_.variables.size(); ++v)
      if (code_.variables[v].symbol != none)
        give_letter(v);
    for (std::uint32_t v = 0; v < code_.variables.size(); ++v)
      give_letter(v);
  }

  void give_letter(std::uint32_t variable) {
    next_letter_ += next_letter_ == compiler::index_letter ? 1 : 0;
    if (letter_of_[variable] == unknown && next_letter_ < unknown)
      letter_of_[variable] = next_letter_++;
  }

  /// Marks the reachable lines, given that tests of constants have only one result.
  void find_reached() {
    std::vector<std::uint32_t> line_of(code_.labels, none);
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i)
      if (code_.lines[i].kind == LineKind::Label)
        line_of[code_.lines[i].label] = i;
    reached_.assign(code_.lines.size(), false);
    std::vector<std::uint32_t> open{0};
    const auto go = [&](std::uint32_t label) {
      if (label < line_of.size() && line_of[label] != none)
        open.push_back(line_of[label]);
    };
    while (!open.empty()) {
      auto i = open.back();
      open.pop_back();
      for (; i < code_.lines.size() && !reached_[i]; ++i) {
        reached_[i] = true;
        const auto& line = code_.lines[i];
        const auto answer = line.kind == LineKind::If
                                ? answer_of(code_.conditions[line.condition].first)
                                : std::nullopt;
        if (answer != false)
          each_label(code_, line, go);
        if (answer == true || !falls_through(line))
          break;
      }
    }
  }

  /// True if a label is at line `i`, or below it after other labels.
  bool is_label_at(std::size_t i, std::uint32_t label) const {
    for (; i < code_.lines.size() && code_.lines[i].kind == LineKind::Label; ++i)
      if (code_.lines[i].label == label)
        return true;
    return false;
  }

  /// True if a test skips a jump right below it, as in `if … then exit`.
  bool goes_around_jump(std::size_t i) const {
    const auto& line = code_.lines[i];
    return line.kind == LineKind::If && code_.lines[i + 1].kind == LineKind::Goto &&
           is_label_at(i + 2, line.label);
  }

  /// True if the line has no effect: a jump to the next line, or an initial value for a counter
  /// that its loop sets anyway.
  bool is_idle(std::size_t i) const {
    const auto& line = code_.lines[i];
    if (line.kind == LineKind::Goto)
      return is_label_at(i + 1, line.label);
    if (line.kind != LineKind::Let || !code_.is_number(line.term))
      return false;
    auto loop = i + 1;
    if (const auto& test = code_.lines[loop];
        test.kind == LineKind::If && answer_of(code_.conditions[test.condition].first) == false)
      ++loop;
    const auto& next = code_.lines[loop];
    return next.kind == LineKind::For && next.variable == line.variable &&
           code_.is_number(next.term);
  }

  template <typename T>
  static std::uint32_t size(const std::vector<T>& all) {
    return static_cast<std::uint32_t>(all.size());
  }

  // ---- values

  std::uint32_t node(compiler::NodeKind kind, std::uint8_t what, Span span) {
    auto& node = out_.nodes.emplace_back();
    node.kind = kind;
    node.what = what;
    node.span = span;
    node.first = size(out_.nodes) - 1;
    return node.first;
  }
  std::uint32_t number(std::int32_t value, Span span) {
    const auto n = node(compiler::NodeKind::Number, 0, span);
    out_.nodes[n].value = value;
    return n;
  }
  std::uint32_t over(compiler::NodeKind kind, std::uint8_t what, Span span, std::uint32_t first) {
    const auto n = node(kind, what, span);
    out_.nodes[n].first = first;
    return n;
  }

  /// The source span of a term; for a generated term, the statement.
  Span span_of(std::uint32_t index) const {
    const auto& source = code_.terms[index].source;
    return source.size() > 0 ? source : here_;
  }

  std::uint32_t value(std::uint32_t index) {
    const auto& term = code_.terms[index];
    const auto span = span_of(index);
    switch (term.kind) {
    case TermKind::Number: return number(term.value, span);
    case TermKind::Variable: return read(term.left, span);
    case TermKind::Element: return node(compiler::NodeKind::Indexed, 0, span);
    case TermKind::System: return node(compiler::NodeKind::System, term.what, span);
    case TermKind::Call: {
      const auto operand = value(term.left);
      return over(compiler::NodeKind::Call, term.what, span, out_.nodes[operand].first);
    }
    case TermKind::Binary: {
      const auto left = value(term.left);
      value(term.right);
      return over(compiler::NodeKind::Binary, term.what, span, out_.nodes[left].first);
    }
    }
    return number(0, span);
  }

  std::uint32_t read(std::uint32_t variable, Span span) {
    if (letter(variable) != unknown)
      return node(compiler::NodeKind::Letter, letter(variable), span);
    const auto n = number(0, span);
    out_.nodes[n].overflow = true;
    return n;
  }

  std::uint8_t letter(std::uint32_t variable) const {
    return static_cast<std::uint8_t>(letter_of_[variable]);
  }

  // ---- items

  void item(compiler::ItemKind kind, std::uint32_t value, Span span) {
    out_.items.push_back({kind, value, span});
  }
  void expression(std::uint32_t term) {
    const auto root = value(term);
    item(compiler::ItemKind::Expression, root, out_.nodes[root].span);
  }
  void target(std::uint32_t label) { item(compiler::ItemKind::Target, label, here_); }
  void variable(std::uint32_t v, Span span) { item(compiler::ItemKind::Letter, letter(v), span); }

  // ---- statements

  /// Begins a statement; items and nodes added before end() belong to it.
  std::uint32_t begin(spec::Statement kind) {
    auto& statement = out_.statements.emplace_back();
    statement.kind = kind;
    statement.items_begin = size(out_.items);
    statement.nodes_begin = size(out_.nodes);
    statement.span = here_;
    statement.word = word_;
    return size(out_.statements) - 1;
  }
  void end(std::uint32_t statement) {
    out_.statements[statement].items_end = size(out_.items);
    out_.statements[statement].nodes_end = size(out_.nodes);
  }
  /// Begins a jump or a call.
  std::uint32_t begin_jump(spec::Statement kind, std::uint32_t label) {
    const auto jump = begin(kind);
    target(label);
    return jump;
  }
  void go_to(std::uint32_t label) { end(begin_jump(spec::Statement::Goto, label)); }

  void begin_line() {
    auto& line = out_.lines.emplace_back();
    line.number = size(out_.lines);
    line.statement = size(out_.statements);
    line.span = here_;
  }

  const Statement& origin(const CodeLine& line) const { return program_.statements[line.origin]; }

  /// The span of the variable set by an assignment, a loop or `read`.
  Span place_of(const CodeLine& line, std::uint32_t variable) const {
    for (const auto& part : program_.items_of(origin(line)))
      if (part.kind == structured::ItemKind::Place && code_.variables[variable].symbol != none)
        return part.span;
    return here_;
  }

  void write(const CodeLine& line) {
    if (line.kind == LineKind::Nothing)
      return;
    if (line.kind == LineKind::Label) {
      number_of_[line.label] = size(out_.lines) + 1;
      return;
    }
    here_ = origin(line).span;
    word_ = origin(line).word;
    if (line.kind == LineKind::Switch)
      return write_switch(line);
    if (line.kind == LineKind::If)
      return write_if(code_.conditions[line.condition].first, line.label);
    begin_line();
    end(write_statement(line));
  }

  std::uint32_t write_statement(const CodeLine& line) {
    switch (line.kind) {
    case LineKind::Let: {
      const auto let = begin(spec::Statement::Let);
      variable(line.variable, place_of(line, line.variable));
      expression(line.term);
      return let;
    }
    case LineKind::SetElement: {
      const auto let = begin(spec::Statement::Let);
      item(compiler::ItemKind::Indexed, 0, here_);
      expression(line.term);
      return let;
    }
    case LineKind::SetSystem: {
      const auto let = begin(spec::Statement::Let);
      item(compiler::ItemKind::System, line.variable, program_.items_of(origin(line))[0].span);
      expression(line.term);
      return let;
    }
    case LineKind::Goto: return begin_jump(spec::Statement::Goto, line.label);
    case LineKind::Gosub: return begin_jump(spec::Statement::Gosub, line.label);
    case LineKind::Return: return begin(spec::Statement::Return);
    case LineKind::For: return write_for(line);
    case LineKind::Next: {
      const auto next = begin(spec::Statement::Next);
      variable(line.variable, here_);
      return next;
    }
    case LineKind::Print: return write_print(line);
    case LineKind::Do: return write_do(line);
    case LineKind::Nothing: // not produced by lowering, or written elsewhere
    case LineKind::Label:
    case LineKind::If:
    case LineKind::Switch:
    case LineKind::On:
    case LineKind::Choice: break;
    }
    return begin(spec::Statement::End);
  }

  std::uint32_t write_for(const CodeLine& line) {
    const auto loop = begin(spec::Statement::For);
    variable(line.variable, place_of(line, line.variable));
    expression(line.term);
    expression(line.end);
    if (line.step != 1)
      item(compiler::ItemKind::Expression, number(line.step, here_), here_);
    return loop;
  }

  std::uint32_t write_print(const CodeLine& line) {
    const auto print = begin(spec::Statement::Print);
    for (auto i = line.parts_begin; i < line.parts_end; ++i) {
      const auto& part = code_.parts[i];
      if (part.kind == PartKind::Term)
        expression(part.value);
      else if (part.kind == PartKind::Character)
        item(compiler::ItemKind::Character, value(part.value), here_);
      else if (part.kind == PartKind::Text)
        item(compiler::ItemKind::String, 0, {part.text.begin - 1, part.text.end + 1});
      else
        item(part.kind == PartKind::Blank ? compiler::ItemKind::Comma
                                          : compiler::ItemKind::Semicolon,
             0, here_);
    }
    return print;
  }

  std::uint32_t write_do(const CodeLine& line) {
    const auto action = begin(line.robot);
    for (auto i = line.parts_begin; i < line.parts_end; ++i) {
      const auto& part = code_.parts[i];
      if (part.kind == PartKind::Variable)
        variable(part.value, here_);
      else if (part.kind == PartKind::Element)
        item(compiler::ItemKind::Indexed, 0, here_);
      else if (part.kind == PartKind::Restart)
        restart(program_.items_of(origin(line)).back().span);
      else
        expression(part.value);
    }
    return action;
  }

  /// The number of the first line.
  void restart(Span word) { item(compiler::ItemKind::Expression, number(1, word), word); }

  // ---- conditions

  void write_if(const Relation& relation, std::uint32_t label) {
    if (const auto answer = answer_of(relation)) {
      if (*answer) {
        begin_line();
        go_to(label);
      }
      return;
    }
    begin_line();
    const auto test = begin(spec::Statement::If);
    write_relation(relation);
    end(test);
    add_branch(test, label);
  }

  /// Writes the jump that a test skips: to `label` if the test fails.
  void write_jump(const CodeLine& line, std::uint32_t label) {
    here_ = origin(line).span;
    word_ = origin(line).word;
    auto relation = code_.conditions[line.condition].first;
    relation.comparison = opposite(relation.comparison);
    write_if(relation, label);
  }

  void add_branch(std::uint32_t test, std::uint32_t label) {
    out_.statements[test].then_branch = size(out_.statements);
    go_to(label);
  }

  /// The result of comparing two constants.
  std::optional<bool> answer_of(const Relation& relation) const {
    if (!code_.is_number(relation.left) || !code_.is_number(relation.right))
      return std::nullopt;
    const auto left = code_.terms[relation.left].value;
    const auto right = code_.terms[relation.right].value;
    return holds(relation.comparison, left, right);
  }

  /// Writes a relation in source order; for `<=` and `>=`, which the robot lacks, adjusts one side
  /// by one.
  void write_relation(Relation relation) {
    if (span_of(relation.right).begin < span_of(relation.left).begin) {
      std::swap(relation.left, relation.right);
      relation.comparison = mirrored(relation.comparison);
    }
    const bool up = relation.comparison == Comparison::LessEqual;
    const bool moves = up || relation.comparison == Comparison::GreaterEqual;
    const bool on_left =
        moves && !code_.is_number(relation.right) && code_.is_number(relation.left);
    const auto sign = up ? spec::Relation::Less : spec::Relation::Greater;
    side(relation.left, !on_left ? 0 : up ? -1 : 1);
    item(compiler::ItemKind::Relation,
         static_cast<std::uint32_t>(moves ? sign : relation_of(relation.comparison)), here_);
    side(relation.right, !moves || on_left ? 0 : up ? 1 : -1);
  }

  void side(std::uint32_t term, std::int32_t added) {
    const auto span = span_of(term);
    if (added == 0)
      return expression(term);
    if (code_.is_number(term))
      return item(compiler::ItemKind::Expression,
                  number(bytecode::add(code_.terms[term].value, added), span), span);
    const auto left = value(term);
    number(1, span);
    const auto sum = over(compiler::NodeKind::Binary,
                          static_cast<std::uint8_t>(added > 0 ? Operator::Add : Operator::Subtract),
                          span, out_.nodes[left].first);
    item(compiler::ItemKind::Expression, sum, span);
  }

  void write_switch(const CodeLine& line) {
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      write_case(line, code_.cases[i]);
    begin_line();
    go_to(line.label);
  }

  void write_case(const CodeLine& line, const Case& one) {
    begin_line();
    const auto test = begin(spec::Statement::If);
    const auto compare = [&](spec::Relation relation, std::int32_t bound) {
      item(compiler::ItemKind::Expression, read(line.variable, here_), here_);
      item(compiler::ItemKind::Relation, static_cast<std::uint32_t>(relation), here_);
      item(compiler::ItemKind::Expression, number(bound, here_), here_);
    };
    if (one.lo == one.hi) {
      compare(spec::Relation::Equal, one.lo);
    } else {
      compare(spec::Relation::Greater, bytecode::subtract(one.lo, 1));
      item(compiler::ItemKind::And, 0, here_);
      compare(spec::Relation::Less, bytecode::add(one.hi, 1));
    }
    end(test);
    add_branch(test, one.label);
  }

  const Program& program_;
  const Code& code_;
  compiler::Program out_;
  std::vector<std::uint32_t> letter_of_; ///< of each variable
  std::uint32_t next_letter_ = 0;
  std::vector<bool> reached_;            ///< by line
  std::vector<std::uint32_t> number_of_; ///< of each label, the line below it
  Span here_;                            ///< the current statement
  Span word_;                            ///< its word
};

} // namespace

compiler::Program source_lines(const Program& program, const Code& code) {
  return SourceLines(program, code).run();
}

} // namespace orb::structured
