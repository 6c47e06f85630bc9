#include "compiler/check.h"

#include "base/text/utf8.h"
#include "compiler/text/image.h"
#include "compiler/text/parse_basic.h"
#include "compiler/text/rules.h"
#include "compiler/text/texts.h"
#include "repair/idioms.h"
#include "repair/program_names.h"
#include "spec/basic.h"
#include "spec/limits.h"

#include <algorithm>
#include <utility>

namespace orb::compiler {
namespace {

/// True if the text has a NUL before its end, or more control characters than a text would have.
bool is_binary(std::string_view text) {
  const auto last = text.find_last_not_of('\0');
  const auto content =
      last == std::string_view::npos ? std::string_view() : text.substr(0, last + 1);
  if (content.find('\0') != std::string_view::npos)
    return true;
  constexpr std::size_t one_in = 16;
  std::size_t controls = 0;
  for (const char c : content)
    controls += is_binary_byte[static_cast<unsigned char>(c)] ? 1 : 0;
  return controls * one_in > content.size();
}

bool holds_program(const Program& program) {
  return std::any_of(program.lines.begin(), program.lines.end(),
                     [](const Line& line) { return line.has_number() || line.has_statement(); });
}

/// All words of the language. `roll`, the sensor, and `goroll` are distinct words.
std::vector<std::string_view> all_words() {
  std::vector<std::string_view> words{"then", "else", "and", "or", "to", "step"};
  for (const auto& row : spec::statements)
    words.push_back(row.word);
  for (const auto& row : spec::functions)
    words.push_back(row.word);
  for (const auto& row : spec::variables)
    if (row.word.size() > 1)
      words.push_back(row.word);
  return words;
}

void offer_lines(const Program& program, const Target& target, std::vector<Diagnostic>& findings) {
  repair::Dialect dialect;
  dialect.language = repair::Language::Basic;
  dialect.words = all_words();
  dialect.parses = [](std::string_view line) { return parse(line).faults.empty(); };
  dialect.check = [&target](std::string_view text) { return lint(parse(text), target); };
  repair::offer_program(program.text, dialect, findings);
}

} // namespace

std::optional<Diagnostic> refuse_text(std::string_view text) {
  const auto most = static_cast<std::size_t>(spec::value_of(spec::Limit::SourceBytes));
  if (text.size() > most)
    return finding(rules::SourceTooLarge, {0, 0}, texts::FileTooLarge(text.size(), most),
                   texts::LargestArea(spec::value_of(spec::Limit::FlashBytes)));
  if (is_binary(text))
    return finding(rules::BinaryFile, {0, 0}, texts::FileIsBinary(), texts::ProgramsArePlainText());
  return std::nullopt;
}

Checked read(std::string_view text) {
  Checked checked;
  if (auto refused = refuse_text(text)) {
    checked.diagnostics.push_back(std::move(*refused));
    return checked;
  }
  checked.program = parse(text);
  if (!holds_program(checked.program))
    checked.diagnostics.push_back(finding(rules::EmptyProgram, {0, 0}, texts::NoProgramLines(),
                                          texts::ALineIs("10 print \"hello\"")));
  return checked;
}

std::vector<Diagnostic> check(const Program& program, const Target& target) {
  auto findings = lint(program, target);
  if (any_error(findings))
    offer_lines(program, target, findings);
  repair::say_foreign(program.text, repair::Language::Basic, findings);
  say_lines(program.text, findings);
  return findings;
}

Checked check(std::string_view text, const Target& target) {
  auto checked = read(text);
  if (!checked.diagnostics.empty())
    return checked;
  checked.diagnostics = check(checked.program, target);
  checked.image_bytes = image_size(checked.program);
  return checked;
}

Fixed fix(std::string text, const Target& target) {
  // Check the results of a fix without searching for repairs, which takes a hundred times as long.
  return fix_all(
      std::move(text),
      [&target](std::string_view changed) { return check(changed, target).diagnostics; },
      [&target](std::string_view changed) {
        const auto program = parse(changed);
        return holds_program(program) ? lint(program, target) : check(changed, target).diagnostics;
      });
}

} // namespace orb::compiler
