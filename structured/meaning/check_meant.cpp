#include "base/text/text.h"
#include "structured/meaning/check_pass.h"

#include "base/fixes.h"
#include <algorithm>
#include <fmt/format.h>

namespace orb::structured {
namespace {

/// The indentation of the line at an offset.
std::string_view indent_at(std::string_view text, std::uint32_t offset) {
  const auto before = text.find_last_of("\r\n", offset);
  const auto begin = before == std::string_view::npos ? 0 : before + 1;
  const auto end = std::min(text.find_first_not_of(" \t", begin), text.size());
  return text.substr(begin, end - begin);
}

bool is_deeper(std::string_view inner, std::string_view outer) {
  return inner.size() > outer.size() && inner.starts_with(outer);
}

/// Checks valid code that does not do what it appears to.
class MeantPass : private CheckPass {
public:
  using CheckPass::CheckPass;

  void run() {
    check_parameters();
    check_indented();
    for (const auto i : program_.order)
      if (at(i).kind == Kind::Assign)
        check_limit(i);
    for (const auto& routine : names_.routines)
      for (const auto local : routine.locals)
        if (names_.symbols[local].kind == SymbolKind::Local)
          check_local(names_.symbols[local].statement, local);
  }

private:
  /// Reports an assignment to a parameter, which the caller never sees.
  // ---- parameters

  void check_parameters() {
    for (const auto i : program_.order) {
      if (at(i).kind != Kind::Assign)
        continue;
      const auto place = item(at(i), 0).value;
      const auto symbol = names_.of_node[place];
      if (program_.nodes[place].kind != NodeKind::Name || symbol == none ||
          names_.symbols[symbol].kind != SymbolKind::Parameter || is_read_after(i, symbol))
        continue;
      const auto routine = names_.routine_of[i];
      const bool function =
          names_.symbols[names_.routines[routine].symbol].kind == SymbolKind::Function;
      if (function && !gives_value(program_, names_, routine))
        continue; // the missing `return` is reported elsewhere
      const auto name = program_.name(names_.symbols[symbol].name);
      report(rules::UnusedName, item(at(i), 0).span, texts::CallerNeverSees(name),
             function ? texts::ReturnIt(fmt::format("return {}", name))
                      : texts::FunctionGivesBack(fmt::format("return {}", name)));
    }
  }

  /// True if the value that a statement assigns to a parameter may be read. Ignores control flow:
  /// every read below counts, and in a loop, or if there are labels, every read.
  bool is_read_after(std::uint32_t statement, std::uint32_t symbol) const {
    const auto begin = names_.routines[names_.routine_of[statement]].statement;
    auto first = statement + 1;
    for (auto n = statement; n-- > begin;) {
      if (at(n).kind == Kind::Label)
        return true;
      if (is_loop(at(n).kind) && at(n).next > statement)
        first = n;
    }
    for (auto n = first; n < at(begin).next; ++n)
      for (std::uint32_t part = 0; part < size(at(n)); ++part) {
        const auto& one = item(at(n), part);
        const bool only_set = part == 0 && at(n).kind == Kind::Assign &&
                              (n == statement || at(n).operation == Statement::none_operation) &&
                              program_.nodes[one.value].kind == NodeKind::Name;
        if (!only_set && mentions(one, symbol))
          return true;
      }
    return false;
  }

  // ---- sums

  /// The variable that an assignment sets; none for an element.
  std::uint32_t symbol_set(std::uint32_t i) const {
    const auto place = item(at(i), 0).value;
    return program_.nodes[place].kind == NodeKind::Name ? names_.of_node[place] : none;
  }

  /// Reports `pace = max(pace + 15, 120)` in a loop: the sum is soon the greater one.
  void check_limit(std::uint32_t i) {
    if (at(i).depth == 0 || at(i).operation != Statement::none_operation)
      return;
    const auto root = item(at(i), 1).value;
    const auto& node = program_.nodes[root];
    if (node.kind != NodeKind::Least && node.kind != NodeKind::Greatest)
      return;
    const auto second = root - 1;
    const auto first = program_.nodes[second].first - 1;
    const auto wanted =
        node.kind == NodeKind::Greatest ? spec::Operator::Add : spec::Operator::Subtract;
    const auto symbol = symbol_set(i);
    for (const auto& [sum, limit] : {std::pair(first, second), std::pair(second, first)}) {
      const auto& one = program_.nodes[sum];
      const auto by =
          one.kind == NodeKind::Binary ? evaluate(program_, names_, sum - 1) : std::nullopt;
      const auto most = evaluate(program_, names_, limit);
      if (!by || !most || by->value <= 0 || static_cast<spec::Operator>(one.what) != wanted ||
          one.first + 2 != sum || program_.nodes[one.first].kind != NodeKind::Name ||
          names_.of_node[one.first] != symbol || symbol == none)
        continue;
      if (is_kept_otherwise(symbol, i))
        return;
      const auto span = item(at(i), 1).span;
      const bool up = wanted == spec::Operator::Add;
      const auto name = program_.name(names_.symbols[symbol].name);
      auto line = std::string(program_.text_of(at(i).span));
      const std::string_view word = up ? "min" : "max";
      line.replace(span.begin - at(i).span.begin, word.size(), word);
      auto& d =
          report(compiler::rules::LostUpdate, span,
                 (up ? texts::GrowsPast : texts::FallsPast)(name, most->value), texts::Write(line));
      d.fix = single_fix(d.help, {span.begin, span.begin + 3}, std::string(word), Safety::Unsafe);
      return;
    }
  }

  /// True if another line tests a variable, or sets it but at the start.
  bool is_kept_otherwise(std::uint32_t symbol, std::uint32_t but) const {
    for (const auto i : program_.order) {
      const auto& one = at(i);
      if (i == but ||
          (one.kind == Kind::Assign && symbol_set(i) == symbol && one.depth == 0 && i < but))
        continue;
      if (one.kind != Kind::Robot && one.kind != Kind::Print && one.kind != Kind::Call &&
          mentions(one, symbol))
        return true;
    }
    return false;
  }

  /// Reports a sum in a local variable that nothing else sets: it starts at 0 in each call.
  void check_local(std::uint32_t local, std::uint32_t symbol) {
    const auto routine = names_.routine_of[local];
    std::uint32_t only = none;
    for (auto i = local + 1; i < at(names_.routines[routine].statement).next; ++i) {
      const auto& one = at(i);
      if (one.kind == Kind::Label)
        return;
      if (!mentions(one, symbol))
        continue;
      if (only == none &&
          (one.kind != Kind::Assign || symbol_set(i) != symbol ||
           one.operation == Statement::none_operation || one.depth != at(local).depth))
        return; // it is set or read otherwise first
      if (only == none)
        only = i;
      else if (one.kind != Kind::Robot && (one.kind != Kind::Assign || symbol_set(i) == symbol) &&
               one.kind != Kind::Return && one.kind != Kind::If && one.kind != Kind::Call)
        return;
    }
    if (only != none)
      report(compiler::rules::LostUpdate, at(only).span,
             texts::StartsInEachCall(program_.name(names_.symbols[symbol].name)),
             texts::KeepsItsValue(program_.name(names_.symbols[symbol].name)));
  }

  bool mentions(const Statement& statement, std::uint32_t symbol) const {
    const auto parts = program_.items_of(statement);
    return std::any_of(parts.begin(), parts.end(),
                       [&](const Item& part) { return mentions(part, symbol); });
  }
  bool mentions(const Item& part, std::uint32_t symbol) const {
    for (auto n = part.has_nodes() ? program_.nodes[part.value].first : part.value + 1;
         n <= part.value; ++n)
      if (program_.nodes[n].kind == NodeKind::Name && names_.of_node[n] == symbol)
        return true;
    return false;
  }

  /// Reports lines that are indented as if they belonged to the one-line `if` above.
  void check_indented() {
    const std::string_view text = program_.text;
    const auto indent = [&](std::uint32_t i) { return indent_at(text, at(i).span.begin); };
    const auto starts_line = [&](std::uint32_t i) {
      return at(i).span.size() > 0 && indent(i).end() == text.begin() + at(i).span.begin;
    };
    for (const auto& file : program_.files)
      for (auto i = file.statements_begin; i < file.statements_end; ++i) {
        if (at(i).kind != Kind::If || !at(i).one_line || !starts_line(i))
          continue;
        auto below = i;
        while (at(below).next != none)
          below = at(below).next;
        ++below;
        if (below >= file.statements_end || at(below).depth != at(i).depth || !starts_line(below) ||
            !is_deeper(indent(below), indent(i)) || never_reached(i, below) == nullptr)
          continue;
        auto above = i; // the previous statement in its block
        while (above-- > file.statements_begin && at(above).depth >= at(i).depth)
          if (at(above).depth == at(i).depth && starts_line(above))
            break;
        if (above < i && above >= file.statements_begin && at(above).depth == at(i).depth &&
            is_deeper(indent(above), indent(i)))
          continue; // the `if` itself is indented too little
        const Span head{at(i).span.begin, item(at(i), 0).span.end};
        auto& d =
            report(rules::MisleadingIndent, at(below).span, texts::RunsAnyway(),
                   texts::MakeABlock(fmt::format("{} then", program_.text_of(head)), "end if"));
        d.notes.push_back({head, texts::IfEndsHere()});
      }
  }
};

} // namespace

void check_meant(Program& program, const Names& names) {
  MeantPass(program, names).run();
}

} // namespace orb::structured
