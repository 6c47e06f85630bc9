#include "structured/compile.h"

#include "base/fixes.h"
#include "compiler/text/image.h"
#include "compiler/text/parse_basic.h"
#include "repair/repair.h"
#include "spec/limits.h"
#include "structured/emit/choices.h"
#include "structured/emit/findings.h"
#include "structured/emit/size.h"
#include "structured/emit/source_lines.h"
#include "structured/lower/lower.h"
#include "structured/lower/lowering_plan.h"
#include "structured/meaning/check.h"
#include "structured/optimise/optimise.h"
#include "structured/text/link_blocks.h"
#include "structured/text/parse_structured.h"
#include "structured/text/read.h"
#include "structured/text/rules.h"
#include "structured/text/silence.h"
#include "structured/text/structured_words.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::structured {
namespace {

/// The preferred letter of a variable: its own name if that is a letter, else its first letter.
std::vector<std::uint8_t> wishes_of(const Program& program, const Names& names, const Code& code) {
  std::vector<std::uint8_t> wishes(code.variables.size(), no_letter);
  for (std::size_t v = 1; v < code.variables.size(); ++v) {
    const auto symbol = code.variables[v].symbol;
    if (symbol == none)
      continue;
    const char first = to_lower(program.name(names.symbols[symbol].name).front());
    if (is_letter(first) && first < 'z')
      wishes[v] = static_cast<std::uint8_t>(first - 'a');
  }
  return wishes;
}

void report_crowd(Compiled& compiled) {
  const auto& letters = compiled.letters;
  auto& program = compiled.program;
  std::string names;
  std::size_t listed = 0;
  for (const auto variable : letters.crowd) {
    const auto symbol = compiled.code.variables[variable].symbol;
    if (symbol == none || listed == 30)
      continue;
    names += fmt::format("{}`{}`", listed == 0 ? "" : ", ",
                         program.name(compiled.names.symbols[symbol].name));
    ++listed;
  }
  const auto& statement = program.statements[compiled.code.lines[letters.crowded_line].origin];
  program.diagnostics.push_back(finding(rules::TooManyVariables, statement.span,
                                        texts::LiveAtOnce(letters.crowd.size(), letters.available),
                                        texts::InUse(std::move(names))));
}

bool report_chain(Compiled& compiled, const Plan& plan) {
  if (plan.chain.empty())
    return false;
  auto& program = compiled.program;
  Message chain;
  constexpr std::size_t told = 6; // names shown; of a long chain, the first and the last
  for (std::size_t i = 0; i < plan.chain.size(); ++i) {
    const auto& routine = compiled.names.routines[plan.chain[i]];
    if (const auto left_out = plan.chain.size() - told;
        plan.chain.size() > told + 1 && i == told / 2) {
      chain = texts::CallsMore(std::move(chain), left_out);
      i += left_out - 1;
      continue;
    }
    const auto name = program.name(compiled.names.symbols[routine.symbol].name);
    chain = chain.empty() ? texts::Quoted(name) : texts::Calls(std::move(chain), name);
  }
  const auto& last = compiled.names.symbols[compiled.names.routines[plan.chain.back()].symbol];
  program.diagnostics.push_back(
      finding(rules::CallDepth, last.span,
              texts::CallsTooDeep(spec::value_of(spec::Limit::GosubDepth), std::move(chain)),
              texts::InlineOne()));
  return true;
}

/// The elements that a statement reads or sets.
std::vector<std::uint32_t> elements_of(const Compiled& compiled, const Statement& statement) {
  const auto& nodes = compiled.program.nodes;
  std::vector<std::uint32_t> elements;
  for (const auto& item : compiled.program.items_of(statement))
    if (item.has_nodes())
      for (auto n = nodes[item.value].first; n <= item.value; ++n)
        if (nodes[n].kind == NodeKind::Element && compiled.names.of_node[n] != none)
          elements.push_back(n);
  return elements;
}

Diagnostic wrong_index(const Compiled& compiled, const WrongIndex& wrong) {
  const auto& program = compiled.program;
  const auto& statement = program.statements[wrong.statement];
  const auto elements = elements_of(compiled, statement);
  if (elements.size() != 1)
    return finding(rules::ArrayIndex, statement.span, texts::OutOfBounds());
  const auto& array = compiled.names.symbols[compiled.names.of_node[elements.front()]];
  const auto name = program.name(array.name);
  return finding(rules::ArrayIndex, program.nodes[elements.front() - 1].span,
                 wrong.index.constant()
                     ? texts::HasElements(name, 1, array.value, wrong.index.lo - array.base)
                     : texts::NeverAnElement(name, array.value));
}

/// Reports indices that certainly stop the program; returns true if there are any.
bool report_indices(Compiled& compiled) {
  for (const auto& wrong : compiled.code.wrong_indices)
    compiled.program.diagnostics.push_back(wrong_index(compiled, wrong));
  return !compiled.code.wrong_indices.empty();
}

bool has_program(const Program& program) {
  const auto& main = program.files.front();
  for (auto i = main.statements_begin; i < main.statements_end; ++i) {
    const auto& statement = program.statements[i];
    if (statement.kind == Kind::Sub || statement.kind == Kind::Function) {
      if (statement.next != none)
        i = statement.next;
    } else if (!declares(statement.kind)) {
      return true;
    }
  }
  return false;
}

/// Comments for readers: the part of the program, and the source line.
class ReadableComments final : public RobotComments {
public:
  explicit ReadableComments(const Compiled& compiled) : compiled_(compiled) {}

  std::string before(const CodeLine& line) override {
    std::string text;
    const auto& program = compiled_.program;
    const auto before = std::exchange(routine_, line.routine);
    if (before != routine_ && routine_ == 0) {
      text += "' main program\n"; // its last lines come after the subs
    } else if (before != routine_) {
      const auto& symbol = compiled_.names.symbols[compiled_.names.routines[routine_].symbol];
      text += fmt::format("' {} {}\n", symbol.kind == SymbolKind::Sub ? "sub" : "function",
                          program.name(symbol.name));
    }
    if (line.origin == origin_)
      return text;
    origin_ = line.origin;
    const auto span = program.statements[line.origin].span;
    const auto whole = std::string_view(program.text);
    auto begin = span.begin;
    while (begin > 0 && !is_line_end(whole[begin - 1]))
      --begin;
    auto end = begin;
    while (end < whole.size() && !is_line_end(whole[end]))
      ++end;
    auto source = whole.substr(begin, end - begin);
    while (!source.empty() && is_blank(source.front()))
      source.remove_prefix(1);
    return text + fmt::format("'   {}\n", source);
  }

private:
  const Compiled& compiled_;
  std::uint32_t routine_ = 0;
  std::uint32_t origin_ = none;
};

/// Finds the global variable with a name, or none.
std::uint32_t shared_variable(const Program& program, const Names& names, std::string_view name) {
  for (std::uint32_t s = 0; s < names.symbols.size(); ++s)
    if (names.symbols[s].kind == SymbolKind::Variable &&
        equal_words(program.name(names.symbols[s].name), name))
      return s;
  return none;
}

std::uint32_t code_variable(const Code& code, std::uint32_t symbol) {
  for (std::uint32_t v = 1; v < code.variables.size(); ++v)
    if (code.variables[v].symbol == symbol)
      return v;
  return none;
}

void keep(Compiled& compiled, std::string_view name) {
  const auto symbol = shared_variable(compiled.program, compiled.names, name);
  if (symbol == none)
    return;
  auto& code = compiled.code;
  auto variable = code_variable(code, symbol);
  if (variable == none) { // no reachable line sets it
    variable = code.new_variable();
    code.variables[variable].symbol = symbol;
  }
  code.variables[variable].kept = true;
}

/// True if an unread variable is probably a misspelling of another one.
bool is_slip(const Diagnostic& one) {
  return one.rule == &rules::UnusedName && !one.help.empty();
}

/// Compiles the program that was read, as far as its findings permit.
void compile(Compiled& compiled, const compiler::Target& target,
             const std::vector<std::string>& kept, Shape shape) {
  if (compiled.program.statements.empty() && !compiled.has_errors())
    compiled.program.diagnostics.push_back(
        finding(rules::NothingToRun, {0, 0}, texts::NoStatements(), texts::WriteOneLine()));
  compiled.names = resolve(compiled.program);
  check(compiled.program, compiled.names);
  compiled.runs = has_program(compiled.program);
  if (compiled.has_errors() || !compiled.runs)
    return;
  const auto decided = plan(compiled.program, compiled.names);
  if (report_chain(compiled, decided))
    return;
  compiled.code = lower(compiled.program, compiled.names, decided);
  for (const auto& name : kept)
    keep(compiled, name);
  const auto lines =
      compiled.code.too_large ? compiler::Program{} : source_lines(compiled.program, compiled.code);
  optimise(compiled.code, shape);
  if (compiled.code.too_large) {
    report_too_large(compiled, target);
    return;
  }
  if (report_indices(compiled))
    return;
  compiled.letters =
      choose_letters(compiled.code, wishes_of(compiled.program, compiled.names, compiled.code));
  if (compiled.letters.crowded_line != none) {
    report_crowd(compiled);
    return;
  }
  write_choices(compiled.code, compiled.letters, compiled.program);
  compiled.robot = print(compiled.program, compiled.code, compiled.letters, {});
  const auto own = compiled.program.diagnostics.size();
  compiled.lines = compiler::parse(compiled.robot.text);
  compiled.image = compiler::build_image(compiled.lines, compiler::Packing::Packed);
  find_meaning(compiled.program, compiled.names, lines, target);
  check_size(compiled, target);
  // Hold back the consequences of a misspelt name until it is fixed.
  auto& all = compiled.program.diagnostics;
  if (std::any_of(all.begin(), all.end(), is_slip))
    all.erase(std::remove_if(all.begin() + static_cast<std::ptrdiff_t>(own), all.end(),
                             [](const Diagnostic& one) { return !is_error(one); }),
              all.end());
}

std::vector<std::string_view> all_words() {
  std::vector<std::string_view> words(keyword_words.begin(), keyword_words.end());
  const auto colours = colour_names();
  words.insert(words.end(), colours.begin(), colours.end());
  for (const auto& row : spec::statements)
    words.push_back(row.word);
  for (const auto& row : spec::functions)
    words.push_back(row.word);
  for (const auto& row : spec::variables)
    if (row.word.size() > 1)
      words.push_back(row.word);
  return words;
}

/// The findings of the front end about the main file, with spans from its start.
std::vector<Diagnostic> front(const std::string& name, const std::string& path,
                              std::string_view text, Files& files) {
  auto program = read(name, path, text, files);
  const auto names = resolve(program);
  check(program, names);
  silence(program);
  return std::move(findings_by_file(program).front());
}

bool parses(std::string_view line) {
  Program program;
  parse(program, {}, {}, line);
  return std::none_of(program.diagnostics.begin(), program.diagnostics.end(), [](const auto& d) {
    return is_error(d) && d.rule != &rules::UnclosedBlock && d.rule != &rules::BlockEnd &&
           d.rule != &rules::MisplacedStatement;
  });
}

/// Adds a replacement line to each error of the main file.
void offer_lines(Compiled& compiled, std::string_view text, Files& files) {
  auto& program = compiled.program;
  const auto main = program.files.front();
  const auto is_main = [&](const Diagnostic& d) {
    return &program.file_at(d.span.begin) == &program.files.front();
  };
  std::vector<Diagnostic> own;
  for (const auto& d : program.diagnostics)
    if (is_main(d))
      own.push_back(d);
  repair::Dialect dialect;
  dialect.language = repair::Language::Structured;
  dialect.words = all_words();
  dialect.parses = parses;
  dialect.check = [&](std::string_view changed) {
    return front(main.name, main.path, changed, files);
  };
  repair::offer_lines(text, dialect, own);
  std::erase_if(program.diagnostics, is_main);
  program.diagnostics.insert(program.diagnostics.begin(), std::make_move_iterator(own.begin()),
                             std::make_move_iterator(own.end()));
}

} // namespace

Compiled compile(std::string name, std::string path, std::string_view text,
                 const compiler::Target& target, Files& files, const std::vector<std::string>& kept,
                 Shape shape) {
  Compiled compiled;
  compiled.program = read(std::move(name), std::move(path), text, files);
  compile(compiled, target, kept, shape);
  silence(compiled.program);
  if (compiled.has_errors())
    offer_lines(compiled, text, files);
  say_lines(compiled.program.text, compiled.program.diagnostics);
  return compiled;
}

compiler::Program take_lines(Compiled& compiled) {
  auto lines = std::move(compiled.lines);
  lines.text = compiled.robot.text;
  return lines;
}

std::optional<std::uint8_t> letter_of(const Compiled& compiled, std::string_view name) {
  const auto symbol = shared_variable(compiled.program, compiled.names, name);
  const auto variable = symbol == none ? none : code_variable(compiled.code, symbol);
  if (variable >= compiled.letters.of.size() || compiled.letters.of[variable] == no_letter)
    return std::nullopt;
  return compiled.letters.of[variable];
}

Diagnostic nothing_to_run() {
  return finding(rules::NothingToRun, {0, 0}, texts::DeclarationsOnly(), texts::IncludeIt());
}

std::string readable(const Compiled& compiled) {
  if (compiled.robot.lines.empty())
    return {};
  ReadableComments comments(compiled);
  std::string variables;
  for (std::size_t v = 1; v < compiled.code.variables.size(); ++v) {
    const auto symbol = compiled.code.variables[v].symbol;
    if (symbol == none || compiled.letters.of[v] == no_letter)
      continue;
    const auto name = compiled.program.name(compiled.names.symbols[symbol].name);
    const auto line = fmt::format("' {}: {}\n", spec::letter_name(compiled.letters.of[v]), name);
    if (variables.find(line) == std::string::npos)
      variables += line;
  }
  constexpr Numbering by_tens{10, 10};
  return variables +
         print(compiled.program, compiled.code, compiled.letters, by_tens, &comments).text;
}

} // namespace orb::structured
