#include "slips/judge.h"

#include "assembler/lint/lint.h"
#include "base/fixes.h"
#include "compiler/check.h"
#include "compiler/renumber.h"
#include "compiler/text/image.h"
#include "structured/compile.h"
#include "testing/text/test_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <regex>

namespace slips {
namespace {

using orb::Diagnostic;

std::string without_blanks(const std::string& text) {
  std::string out;
  bool quoted = false;
  for (const char c : text) {
    quoted = quoted != (c == '"');
    if (quoted || (c != ' ' && c != '\t'))
      out += c;
  }
  return out;
}

/// Returns the `n`th line between "write `" and "`".
std::vector<std::string> offered(const Diagnostic& finding) {
  std::vector<std::string> lines;
  const auto& help = orb::in_english(finding.help);
  auto at = help.find("write `");
  while (at != std::string::npos) {
    const auto begin = help.find('`', at) + 1;
    const auto end = help.find('`', begin);
    if (end == std::string::npos)
      break;
    lines.push_back(help.substr(begin, end - begin));
    at = help.compare(end, 5, "` or ") == 0 ? end + 4 : std::string::npos;
  }
  return lines;
}

std::string apply(const std::string& text, const orb::Fix& fix) {
  auto out = text;
  for (auto edit = fix.edits.rbegin(); edit != fix.edits.rend(); ++edit)
    out.replace(edit->span.begin, edit->span.size(), edit->text);
  return out;
}

/// Returns the program with the offered line in place of the mistaken one.
Lines placed(const Lines& program, std::size_t at, std::string line) {
  auto changed = program;
  if (!line.empty() && !std::isdigit(static_cast<unsigned char>(line[0]))) {
    const auto& old = program[at];
    const auto head = old.find_first_not_of(" \t0123456789");
    const bool numbered = !old.empty() && std::isdigit(static_cast<unsigned char>(old[0]));
    line.insert(0, numbered && head != std::string::npos ? old.substr(0, head) : "");
  }
  changed[at] = line;
  return changed;
}

} // namespace

std::vector<Diagnostic> findings(Language language, const std::string& text) {
  const orb::Source source("mistake", text);
  orb::structured::NoFiles files;
  std::vector<Diagnostic> found;
  switch (language) {
  case Language::Basic: found = orb::compiler::check(text, {}).diagnostics; break;
  case Language::Structured:
    found = orb::structured::findings_by_file(
                orb::structured::compile("mistake", "mistake", text, {}, files).program)
                .front();
    break;
  case Language::Macro: found = orb::assembler::check(source); break;
  case Language::Test: found = orb::testing::parse(source).diagnostics; break;
  }
  orb::sort_by_place(found);
  return found;
}

Lines split(const std::string& text) {
  Lines lines;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::string join(const Lines& lines) {
  std::string text;
  for (const auto& line : lines)
    text += line + '\n';
  return text;
}

std::string meaning(Language language, const Lines& program) {
  const auto text = join(program);
  if (orb::any_error(findings(language, text)))
    return {};
  switch (language) {
  case Language::Basic: {
    const auto image = [](const std::string& of) {
      const auto parsed = orb::compiler::check(of, {});
      return orb::compiler::build_image(parsed.program, orb::compiler::Packing::Packed).bytes;
    };
    auto bytes = image(text);
    bytes.resize(bytes.find_last_not_of('\0') + 1);
    // Line numbers carry no meaning.
    const auto lines = orb::compiler::check(bytes, {});
    const auto renumbered = orb::compiler::renumber(lines.program, {10, 10});
    if (const auto* plain = std::get_if<std::string>(&renumbered))
      bytes = image(*plain);
    // `10 < D` is `D > 10`.
    static const std::regex turned("(if|and|or) ?([0-9]+) ?([<>]) ?([A-Za-z]+) ?(?=and|or|then)");
    for (std::smatch found; std::regex_search(bytes, found, turned);)
      bytes.replace(static_cast<std::size_t>(found.position()),
                    static_cast<std::size_t>(found.length()),
                    fmt::format("{} {}{}{} ", found.str(1), found.str(4),
                                found.str(3) == "<" ? '>' : '<', found.str(2)));
    bool quoted = false;
    for (std::size_t i = 0; i < bytes.size(); ++i) { // `a` is `A`
      quoted = bytes[i] != '\n' && quoted != (bytes[i] == '"');
      const auto letter = [&](std::size_t at) {
        return at < bytes.size() && std::isalpha(static_cast<unsigned char>(bytes[at])) != 0;
      };
      if (!quoted && letter(i) && !letter(i + 1) && (i == 0 || !letter(i - 1)))
        bytes[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(bytes[i])));
    }
    return bytes;
  }
  case Language::Structured: {
    orb::structured::NoFiles files;
    return orb::structured::compile("mistake", "mistake", text, {}, files).robot.text;
  }
  case Language::Macro: {
    const auto assembly = orb::assembler::assemble(orb::Source("mistake", text));
    std::string bytes;
    for (const auto& macro : assembly.macros)
      bytes += std::string(macro.body.begin(), macro.body.end());
    return bytes;
  }
  case Language::Test: {
    std::string all;
    for (const auto& line : program)
      all += without_blanks(line.substr(0, line.find('#') == 0 ? 0 : std::string::npos)) + '\n';
    return all;
  }
  }
  return {};
}

Judged judge(Language language, const Lines& program, std::size_t at,
             const std::vector<Lines>& meant) {
  const auto text = join(program);
  std::vector<std::string> meanings;
  for (const auto& one : meant)
    if (auto m = meaning(language, one); !m.empty())
      meanings.push_back(std::move(m));
  const auto is_meant = [&](const Lines& lines) {
    const auto m = meaning(language, lines);
    return !m.empty() && std::find(meanings.begin(), meanings.end(), m) != meanings.end();
  };
  const auto found = findings(language, text);
  const orb::Source source("mistake", text);
  const Diagnostic* finding = nullptr;
  for (const auto& one : found)
    if (source.position(one.span.begin).line == at + 1 &&
        (finding == nullptr || (!is_error(*finding) && is_error(one))))
      finding = &one;
  for (const auto& one : found) // a misspelt name is reported where it is used
    if (finding == nullptr && one.fix && is_meant(split(apply(text, *one.fix))))
      return {Grade::Good, orb::in_english(one.help)};
  if (finding == nullptr)
    return {!meanings.empty() && is_meant(program) ? Grade::Good
            : orb::any_error(found)                ? Grade::Wrong
                                                   : Grade::Silent,
            found.empty() ? "" : "elsewhere: " + orb::in_english(found[0].message)};
  const auto said =
      fmt::format("{}; {}", orb::in_english(finding->message), orb::in_english(finding->help));
  if (meant.empty())
    return {finding->help.empty() ? Grade::Named : Grade::Good, said};
  const auto lines = offered(*finding);
  if (finding->fix && is_meant(split(apply(text, *finding->fix))))
    return {Grade::Good, said};
  for (const auto& line : lines)
    if (is_meant(placed(program, at, line)))
      return {Grade::Good, said};
  if (is_meant(program))
    return {Grade::Good, said};
  const bool runs = !lines.empty() && !meaning(language, placed(program, at, lines[0])).empty();
  const bool fixed = finding->fix && !meaning(language, split(apply(text, *finding->fix))).empty();
  return {runs || fixed ? Grade::Wrong : Grade::Named, said};
}

Judged follow(Language language, const Lines& program, const std::vector<std::size_t>& at,
              const std::vector<Lines>& meant) {
  auto first = Judged{Grade::Silent, ""};
  for (const auto line : at) {
    const auto judged = judge(language, program, line, meant);
    if (judged.grade == Grade::Good)
      return judged;
    if (first.grade == Grade::Silent)
      first = judged;
  }
  Lines wrong;
  for (const auto line : at)
    wrong.push_back(program[line]);
  std::vector<std::string> meanings;
  for (const auto& one : meant)
    meanings.push_back(meaning(language, one));
  const auto is_one = [&](const Lines& now) {
    const auto means = meaning(language, now);
    return !means.empty() && std::find(meanings.begin(), meanings.end(), means) != meanings.end();
  };
  // Applies all offers of the first check together.
  auto at_once = findings(language, join(program));
  std::erase_if(at_once, [](const Diagnostic& one) { return !one.fix; });
  for (auto& one : at_once)
    one.fix->safety = orb::Safety::Safe; // all at once
  if (is_one(split(orb::apply_fixes(join(program), at_once).text)))
    return {Grade::Good, first.said};
  auto lines = program;
  bool moved = true;
  for (std::size_t round = 0; moved && round < 2 * at.size() + 2; ++round) {
    moved = false;
    const auto text = join(lines);
    const orb::Source source("mistake", text);
    for (const auto& one : findings(language, text)) {
      const auto line = source.position(one.span.begin).line - 1;
      const bool marked =
          line < lines.size() && std::find(wrong.begin(), wrong.end(), lines[line]) != wrong.end();
      if (!marked && one.severity == orb::Severity::Info)
        continue;
      auto next = lines;
      if (const auto written = offered(one); one.fix)
        next = split(apply(text, *one.fix));
      else if (!written.empty() && line < lines.size())
        next = placed(lines, line, written[0]);
      moved = next != lines;
      lines = std::move(next);
      if (moved)
        break;
    }
    if (is_one(lines))
      return {Grade::Good, first.said};
  }
  if (lines != program && !meaning(language, lines).empty())
    return {Grade::Wrong, first.said + " => " + join(lines)};
  return first.grade == Grade::Wrong ? Judged{Grade::Named, first.said} : first;
}

Lines said_of(Language language, const Lines& program) {
  const auto text = join(program);
  const orb::Source source("program", text);
  Lines said;
  for (const auto& one : findings(language, text))
    said.push_back(fmt::format("{}: {} [{}]: {}{}{}", source.position(one.span.begin).line,
                               to_string(one.severity), one.rule->id, orb::in_english(one.message),
                               one.help.empty() ? "" : "; ", orb::in_english(one.help)));
  return said;
}

std::vector<orb::Message> messages_of(Language language, const Lines& program) {
  std::vector<orb::Message> messages;
  for (const auto& one : findings(language, join(program))) {
    messages.push_back(one.message);
    if (!one.help.empty())
      messages.push_back(one.help);
    for (const auto& note : one.notes)
      messages.push_back(note.message);
  }
  return messages;
}

} // namespace slips
