#include "base/text/suggest.h"
#include "base/text/text.h"
#include "structured/meaning/checker.h"

namespace orb::structured {

void Checker::run() {
  for (const auto& statement : program_.statements)
    note_timer(statement);
  for (const auto i : program_.order) {
    const auto& statement = program_.statements[i];
    check_expressions(statement);
    check_place(i, statement);
    check_statement(statement);
    follow(i, statement);
  }
  check_jumps();
  const auto& found = program_.diagnostics;
  if (std::none_of(found.begin(), found.end(), [](const Diagnostic& one) {
        return one.rule == &rules::UnclosedBlock || one.rule == &rules::BlockEnd;
      }))
    check_recursion(); // a sub without its end contains the calls below it
  check_unused();
  check_values();
  if (!any_error(program_.diagnostics)) {
    check_parameters();
    check_indented();
    check_loops();
  }
}

Diagnostic& Checker::report(const Rule& rule, Span span, Message message, Message help) {
  return program_.diagnostics.emplace_back(
      finding(rule, span, std::move(message), std::move(help)));
}

const Item& Checker::item(const Statement& statement, std::uint32_t n) const {
  return program_.items[statement.items_begin + n];
}

std::uint32_t Checker::size(const Statement& statement) {
  return statement.items_end - statement.items_begin;
}

std::optional<Constant> Checker::value_of(const Item& part) const {
  return evaluate(program_, names_, part.value);
}

void Checker::follow(std::uint32_t i, const Statement& statement) {
  if (opens_block(statement.role()))
    open_.push_back(i);
  else if (closes_block(statement.role()) && statement.opener != none)
    while (!open_.empty() && open_.back() >= statement.opener) // including unclosed ones
      open_.pop_back();
}

bool Checker::in_loop() const {
  return std::any_of(open_.begin(), open_.end(),
                     [&](std::uint32_t opener) { return is_loop(at(opener).role()); });
}

bool Checker::in_select() const {
  return std::any_of(open_.begin(), open_.end(),
                     [&](std::uint32_t opener) { return at(opener).role() == Kind::Select; });
}

bool Checker::in_broken_routine() const {
  return std::any_of(open_.begin(), open_.end(), [&](std::uint32_t opener) {
    return at(opener).meant == Kind::Sub || at(opener).meant == Kind::Function;
  });
}

void Checker::misplaced(const Statement& statement, Message message, Message help) {
  report(rules::MisplacedStatement, statement.word.size() > 0 ? statement.word : statement.span,
         std::move(message), std::move(help));
}

void Checker::stands_outside(const Statement& statement, const Row<Hole::Code>& outside,
                             Message help) {
  auto words = statement.word;
  std::erase_if(program_.diagnostics, [&](const Diagnostic& one) {
    const bool same = one.rule == &rules::ForeignWord && one.span.begin == words.begin;
    words = same ? one.span : words;
    return same;
  });
  report(rules::MisplacedStatement, words, outside(program_.text_of(words)), std::move(help));
}

std::uint32_t Checker::none_yet(std::uint32_t i) const {
  const auto next = at(open_.back()).next;
  return next != none && next > i ? next : none - 1;
}

void Checker::check_statement(const Statement& statement) {
  if (statement.kind == Kind::Robot)
    check_robot(statement);
  else if (statement.kind == Kind::For)
    check_for(statement);
  else if (statement.kind == Kind::Next)
    check_next(statement);
  else if (statement.kind == Kind::Case)
    check_case(statement);
  else if (statement.kind == Kind::Assign)
    check_assign(statement);
  else if (statement.kind == Kind::Select && !in_select())
    cases_.clear();
}

namespace {

/// True for names such as `onCollision` and `on_shake`: event handlers in other languages.
bool is_called_by_events(std::string_view name) {
  constexpr std::string_view on = "on";
  return name.size() > on.size() && equal_words(name.substr(0, on.size()), on) &&
         (name[on.size()] == '_' || name[on.size()] != to_lower(name[on.size()]));
}

} // namespace

void Checker::check_unused() {
  if (any_error(program_.diagnostics))
    return; // its reader may be the mistake
  const bool runs = main_file_runs();
  for (const auto& symbol : names_.symbols) {
    if (symbol.read)
      continue;
    if (symbol.kind == SymbolKind::Sub || symbol.kind == SymbolKind::Function)
      check_uncalled(symbol);
    else if (symbol.kind == SymbolKind::Variable)
      report_unused(symbol, texts::SetNeverRead);
    else if (symbol.kind == SymbolKind::Local)
      report_unused(symbol, texts::NeverRead);
    else if (symbol.kind == SymbolKind::Constant && runs && in_main_file(symbol.span))
      report_unused(symbol,
                    texts::NeverUsed); // unused names in an included file may serve other files
  }
}

/// Uncalled subs may be for later use, except event handlers of other languages, which nothing will
/// call.
void Checker::check_uncalled(const Symbol& symbol) {
  const auto name = program_.text_of(symbol.span);
  if (symbol.used || !main_file_runs() || !in_main_file(symbol.span) || !is_called_by_events(name))
    return;
  constexpr std::string_view shake = "shake";
  const bool shakes =
      name.size() > shake.size() && equal_words(name.substr(name.size() - shake.size()), shake);
  report(rules::UnusedName, symbol.span, texts::NeverCalled(name),
         shakes ? texts::AskInLoop("dshake") : texts::AskEitherInLoop("speed", "accelone"));
}

void Checker::report_unused(const Symbol& symbol, const Row<Hole::Code>& unused) {
  const auto name = program_.name(symbol.name);
  std::vector<std::string_view> others; // variables that are read
  for (const auto& other : names_.symbols)
    if (other.kind == SymbolKind::Variable && other.read && other.name != symbol.name)
      others.push_back(program_.name(other.name));
  constexpr std::size_t clear = 3; // letters; shorter names that differ by one are distinct names
  const auto meant = symbol.kind == SymbolKind::Variable && name.size() >= clear
                         ? closest(name, others)
                         : std::nullopt;
  Message help;
  if (meant) {
    const auto line = at(symbol.statement).span;
    help = texts::Write(fmt::format("{}{}{}", program_.text_of({line.begin, symbol.span.begin}),
                                    *meant, program_.text_of({symbol.span.end, line.end})));
  }
  report(rules::UnusedName, symbol.span, unused(name), std::move(help));
}

bool Checker::in_main_file(Span span) const {
  return &program_.file_at(span.begin) == &program_.files.front();
}

bool Checker::main_file_runs() const {
  return std::any_of(program_.statements.begin(), program_.statements.end(),
                     [&](const Statement& one) {
                       return one.depth == 0 && !declares(one.kind) && one.kind != Kind::EndSub &&
                              one.kind != Kind::EndFunction && in_main_file(one.span);
                     });
}

std::string_view Checker::name_of(std::uint32_t routine) const {
  return program_.name(names_.symbols[names_.routines[routine].symbol].name);
}

void check(Program& program, const Names& names, const compiler::Target& target) {
  Checker(program, names, target).run();
}

std::vector<std::vector<std::uint32_t>> calls_of(const Program& program, const Names& names) {
  std::vector<std::vector<std::uint32_t>> calls(names.routines.size());
  for (const auto i : program.order)
    each_call(program, names, i,
              [&](std::uint32_t routine, Span) { calls[names.routine_of[i]].push_back(routine); });
  for (auto& list : calls) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return calls;
}

} // namespace orb::structured
