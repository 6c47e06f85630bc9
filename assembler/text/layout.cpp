#include "assembler/text/layout.h"

#include "base/text/lines.h"
#include "base/text/text.h"
#include "spec/macro.h"

#include <algorithm>

namespace orb::assembler {
namespace {

constexpr std::size_t step = 2; // spaces of indentation per macro or loop

/// The end of the quoted text that begins at `begin`.
std::size_t end_of_text(std::string_view line, std::size_t begin) {
  auto at = begin + 1;
  while (at < line.size() && line[at] != '"')
    at += line[at] == '\\' ? 2 : 1;
  return std::min(at + 1, line.size());
}

/// Normalizes the spaces of a statement: none before a comma, one after it; none around the `=` of
/// an operand; elsewhere runs become one.
std::string respace(std::string_view code) {
  const bool is_const = code.starts_with(".const");
  std::string out;
  for (std::size_t at = 0; at < code.size();) {
    const char c = code[at];
    if (c == '"') {
      const auto end = end_of_text(code, at);
      out += code.substr(at, end - at);
      at = end;
    } else if (is_blank(c)) {
      while (at < code.size() && is_blank(code[at]))
        ++at;
      if (at < code.size() && code[at] != ',' && code[at] != '=' && !out.ends_with(' ') &&
          !out.ends_with('='))
        out += ' ';
    } else {
      ++at;
      if (c == '=' && is_const && !out.ends_with(' '))
        out += ' ';
      out += c;
      const bool more = at < code.size();
      if (more && (c == ',' || (c == '=' && is_const)))
        out += ' ';
    }
  }
  return out;
}

std::string_view first_word(std::string_view code) {
  return code.substr(0, code.find_first_of(" \t,\"#"));
}

bool is(std::string_view word, spec::MacroCommand command) {
  return word == spec::info(command).mnemonic;
}

} // namespace

std::size_t remark_of(std::string_view line) {
  std::size_t at = 0;
  while (at < line.size() && line[at] != '#' && line[at] != ';')
    at = line[at] == '"' ? end_of_text(line, at) : at + 1;
  return std::min(at, line.size());
}

std::string layout(std::string_view text) {
  std::string out;
  bool in_macro = false;
  std::size_t loops = 0;
  bool blank_before = true; // no blank line at the top
  while (!text.empty()) {
    const auto line = take_line(text);
    const auto split = remark_of(line);
    const auto code = respace(trim(line.substr(0, split)));
    const auto remark = trim(line.substr(split));
    if (code.empty() && remark.empty()) {
      blank_before = blank_before || (out += '\n', true);
      continue;
    }
    blank_before = false;
    const auto word = first_word(code);
    const bool header = word == ".macro" || word == ".const";
    if (word == ".macro") {
      in_macro = true;
      loops = 0;
    }
    if (is(word, spec::MacroCommand::LoopEnd) && loops > 0)
      --loops;
    // Indent a remark alone on its line like a statement; above a macro, keep it at the margin.
    auto indent = header ? 0 : (in_macro ? step : 0) + step * loops;
    if (code.empty() && !is_blank(line.empty() ? ' ' : line.front()))
      indent = 0;
    out += std::string(indent, ' ') + code;
    if (!remark.empty())
      out += (code.empty() ? "" : "  ") + std::string(remark);
    out += '\n';
    if (is(word, spec::MacroCommand::LoopStart) || is(word, spec::MacroCommand::LoopStartSystem))
      ++loops;
  }
  while (out.ends_with("\n\n"))
    out.pop_back();
  return out == "\n" ? std::string() : out;
}

} // namespace orb::assembler
