#include "editor/printed/snippets.h"

#include "base/text/text.h"
#include "editor/directives.h"
#include "spec/basic.h"
#include "spec/macro.h"
#include "structured/text/structured_words.h"
#include "testing/text/vocabulary.h"
#include "vm/stimulus.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace orb::editor {
namespace {

using Json = nlohmann::ordered_json;

bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

/// Drops optional parts: `sub NAME[(NAME, …)]` becomes `sub NAME`.
std::string without_options(std::string_view usage) {
  std::string out;
  int depth = 0;
  for (const char c : usage) {
    depth += c == '[' ? 1 : 0;
    if (depth == 0)
      out += c;
    depth -= c == ']' ? 1 : 0;
  }
  while (out.ends_with("…")) // more of the same
    out.resize(out.size() - std::string_view("…").size());
  return std::string(trim(out));
}

/// `while CONDITION` becomes `while ${1:condition}`.
class SnippetBody {
public:
  std::string operator()(std::string_view usage) {
    std::string out;
    for (std::size_t at = 0; at < usage.size();) {
      auto end = at;
      while (end < usage.size() && is_capital(usage[end]))
        ++end;
      const bool is_word = at > 0 && (is_letter(usage[at - 1]) || usage[at - 1] == '_');
      const bool goes_on = end < usage.size() && is_letter(usage[end]);
      if (end == at || is_word || goes_on) {
        out += usage[at++];
        continue;
      }
      std::string name;
      for (; at < end; ++at)
        name += to_lower(usage[at]);
      out += place(name);
    }
    return out;
  }
  std::string place(std::string_view name) { return fmt::format("${{{}:{}}}", ++places_, name); }

private:
  int places_ = 0;
};

void add(Json& all, std::string_view name, std::string_view prefix, std::string body,
         std::string_view summary) {
  all[std::string(name)] = {
      {"prefix", prefix}, {"body", std::move(body)}, {"description", summary}};
}

std::string file_of(const Json& all) {
  return all.dump(2) + "\n";
}

void add_statements(Json& all, std::string_view separator) {
  for (const auto& row : spec::statements) {
    if (row.form != spec::Form::Arguments || row.parameters().empty())
      continue;
    SnippetBody body;
    std::string text(row.word);
    for (const auto& parameter : row.parameters())
      text += fmt::format("{}{}", text == row.word ? " " : separator, body.place(parameter.name));
    add(all, row.word, row.word, std::move(text), row.summary);
  }
}

/// `loop … end loop`: the first and last lines of a block, with one line in between.
void add_blocks(Json& all, const structured::WordInfo& row) {
  constexpr std::string_view between = " · ";
  constexpr std::string_view lines = " … ";
  std::string_view rest = row.usage;
  while (!rest.empty()) {
    const auto end = std::min(rest.find(between), rest.size());
    const auto usage = rest.substr(0, end);
    rest.remove_prefix(std::min(end + between.size(), rest.size()));
    const auto first = without_options(usage.substr(0, usage.find(lines)));
    const auto last_at = usage.rfind(lines);
    if (last_at == usage.npos || usage.find("[else") != usage.npos)
      continue;
    SnippetBody body;
    const auto last = without_options(usage.substr(last_at + lines.size()));
    const auto head = body(first);
    add(all, fmt::format("{} … {}", first, last), row.word,
        fmt::format("{}\n\t$0\n{}", head, body(last)), row.summary);
  }
}

std::string basic_snippets() {
  Json all = Json::object();
  add_statements(all, ",");
  return file_of(all);
}

std::string structured_snippets() {
  Json all = Json::object();
  for (const auto& row : structured::keywords)
    add_blocks(all, row);
  for (const auto& row : structured::wider_words)
    add_blocks(all, row);
  add_statements(all, ", ");
  return file_of(all);
}

std::string macro_snippets() {
  Json all = Json::object();
  for (const auto& row : macro_directives)
    add(all, "." + std::string(row.word), "." + std::string(row.word),
        SnippetBody()(without_options(row.usage)), row.summary);
  for (const auto& row : spec::macro_commands) {
    SnippetBody body;
    std::string text(row.mnemonic);
    for (const auto& operand : row)
      if (operand.kind != spec::MacroOperandKind::Delay || operand.width > 1)
        text += fmt::format("{}{}", text == row.mnemonic ? " " : ", ",
                            operand.kind == spec::MacroOperandKind::Text
                                ? fmt::format("\"{}\"", body.place(operand.name))
                                : body.place(operand.name));
    if (text != row.mnemonic)
      add(all, row.mnemonic, row.mnemonic, std::move(text), row.summary);
  }
  return file_of(all);
}

std::string test_snippets() {
  Json all = Json::object();
  for (const auto& row : testing::line_words)
    if (row.word != "expect" && row.word != "never")
      add(all, row.word, row.word,
          row.word == "test" ? "test \"${1:name}\"\n\t$0" : std::string(row.example), row.summary);
  for (const auto& row : testing::expectations)
    add(all, row.example, fmt::format("expect {}", row.word), fmt::format("${{1:{}}}", row.example),
        row.summary);
  return file_of(all);
}

std::string stimulus_snippets() {
  Json all = Json::object();
  for (const auto& row : vm::stimulus_words)
    add(all, row.example, row.word, fmt::format("${{1:{}}}", row.example), row.summary);
  return file_of(all);
}

} // namespace

std::vector<SyntaxFile> snippet_files() {
  return {{"vscode/snippets/orbbasic.json", basic_snippets()},
          {"vscode/snippets/orbstructured.json", structured_snippets()},
          {"vscode/snippets/orbmacro.json", macro_snippets()},
          {"vscode/snippets/orbtest.json", test_snippets()},
          {"vscode/snippets/orbstimulus.json", stimulus_snippets()}};
}

} // namespace orb::editor
