#include "editor/printed/syntax_files.h"

#include "editor/directives.h"
#include "editor/printed/snippets.h"
#include "editor/printed/tree_sitter.h"
#include "editor/printed/word_lists.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace orb::editor {
namespace {

using Json = nlohmann::ordered_json;

// ---- TextMate grammars

/// Puts longer words first: a shorter one would hide those that begin with it.
std::string alternatives(Words words) {
  std::stable_sort(words.begin(), words.end(),
                   [](std::string_view a, std::string_view b) { return a.size() > b.size(); });
  return fmt::format("{}", fmt::join(words, "|"));
}

/// A pattern for whole words; `part` is the class of word characters.
Json words_pattern(const char* name, const Words& words, std::string_view part) {
  return {{"name", name},
          {"match", fmt::format("(?<![{0}])(?:{1})(?![{0}])", part, alternatives(words))}};
}

Json pattern(const char* name, const char* match) {
  return {{"name", name}, {"match", match}};
}

constexpr auto generated = "Printed by `orb spec --editors docs/editors`; a test compares them.";

std::string basic_textmate() {
  constexpr auto part = "A-Za-z";
  const Json grammar{
      {"comment", generated},
      {"name", "orbBasic"},
      {"scopeName", "source.orbbasic"},
      {"patterns",
       {pattern("comment.line.apostrophe.orbbasic", "'.*$"),
        {{"name", "string.quoted.double.orbbasic"}, {"begin", "\""}, {"end", "\"|$"}},
        pattern("entity.name.label.orbbasic", "^\\s*\\d+"),
        words_pattern("keyword.control.orbbasic", control_words(), part),
        words_pattern("support.function.orbbasic", statement_words(), part),
        words_pattern("support.function.math.orbbasic", function_words(), part),
        words_pattern("variable.language.orbbasic", variable_words(), part),
        pattern("variable.other.orbbasic", "(?<![A-Za-z])[A-Za-z](?![A-Za-z])"),
        pattern("constant.numeric.orbbasic", "\\d+"),
        pattern("keyword.operator.orbbasic", "[-+*/%&|{}=!<>?$]")}}};
  return grammar.dump(2) + "\n";
}

std::string structured_textmate() {
  constexpr auto part = "A-Za-z0-9_";
  const auto words = [&](const char* name, const Words& list) -> Json {
    return {{"name", name},
            {"match", fmt::format("(?i)(?<![{0}])(?:{1})(?![{0}])", part, alternatives(list))}};
  };
  const Json grammar{
      {"comment", generated},
      {"name", "Structured orbBasic"},
      {"scopeName", "source.orbstructured"},
      {"patterns",
       {pattern("comment.line.apostrophe.orbstructured", "'.*$"),
        {{"name", "string.quoted.double.orbstructured"}, {"begin", "\""}, {"end", "\"|$"}},
        pattern("entity.name.label.orbstructured", "^\\s*[A-Za-z_][A-Za-z0-9_]*(?=:)"),
        {{"match", "(?i)(?<![A-Za-z0-9_])(?:sub|function)\\s+([A-Za-z_][A-Za-z0-9_]*)"},
         {"captures",
          {{"0", {{"name", "keyword.control.orbstructured"}}},
           {"1", {{"name", "entity.name.function.orbstructured"}}}}}},
        words("keyword.control.orbstructured", structured_control_words()),
        words("support.function.orbstructured", structured_statement_words()),
        words("support.function.math.orbstructured", function_words()),
        words("variable.language.orbstructured", variable_words()),
        pattern("constant.numeric.orbstructured",
                "#[0-9A-Fa-f]{6}\\b|\\b(?:0[xX][0-9A-Fa-f]+|\\d+(?:\\.\\d+)?(?:ms|s|min)?)\\b"),
        pattern("variable.other.orbstructured", "[A-Za-z_][A-Za-z0-9_]*"),
        pattern("keyword.operator.orbstructured", "[-+*/%&|{}=!<>?$]")}}};
  return grammar.dump(2) + "\n";
}

std::string macro_textmate() {
  constexpr auto part = "A-Za-z0-9_";
  const Json grammar{
      {"comment", generated},
      {"name", "Sphero macro"},
      {"scopeName", "source.orbmacro"},
      {"patterns",
       {pattern("comment.line.number-sign.orbmacro", "#.*$"),
        {{"name", "string.quoted.double.orbmacro"},
         {"begin", "\""},
         {"end", "\"|$"},
         {"patterns", Json::array({pattern("constant.character.escape.orbmacro", "\\\\.")})}},
        {{"match",
          fmt::format("^\\s*\\.({})(?![{}])", alternatives(macro_directive_words()), part)},
         {"name", "keyword.control.directive.orbmacro"}},
        pattern("variable.parameter.orbmacro", "[A-Za-z_][A-Za-z0-9_]*(?=\\s*=)"),
        {{"match", fmt::format("^\\s*({})(?![{}])", alternatives(macro_command_words()), part)},
         {"name", "support.function.orbmacro"}},
        words_pattern("constant.language.orbmacro", macro_value_words(), part),
        pattern("constant.numeric.orbmacro",
                "[-+]?(?:0[xX][0-9A-Fa-f]+|\\d+(?:\\.\\d+)?)(?:ms|s|deg)?(?![A-Za-z0-9_])")}}};
  return grammar.dump(2) + "\n";
}

std::string test_textmate() {
  constexpr auto part = "A-Za-z0-9_";
  const Json grammar{
      {"comment", generated},
      {"name", "orb test"},
      {"scopeName", "source.orbtest"},
      {"patterns",
       {pattern("constant.other.color.orbtest", "#[0-9A-Fa-f]{6}\\b"),
        pattern("comment.line.number-sign.orbtest", "#.*$"),
        {{"name", "string.quoted.double.orbtest"}, {"begin", "\""}, {"end", "\"|$"}},
        pattern("string.regexp.orbtest", "(?<=print )/(?:\\\\.|[^/])*/"),
        words_pattern("keyword.control.orbtest", test_words(), part),
        words_pattern("support.function.orbtest", expectation_words(), part),
        words_pattern("support.function.stimulus.orbtest", stimulus_words(), part),
        pattern("constant.numeric.orbtest",
                "[-+]?\\d+(?:\\.\\d+)?(?:ms|s|min|mm|cm|m|deg)?(?:/s)?(?![A-Za-z0-9_])")}}};
  return grammar.dump(2) + "\n";
}

std::string stimulus_textmate() {
  constexpr auto part = "A-Za-z0-9_";
  const Json grammar{{"comment", generated},
                     {"name", "Stimulus script"},
                     {"scopeName", "source.orbstimulus"},
                     {"patterns",
                      {pattern("comment.line.number-sign.orbstimulus", "#.*$"),
                       words_pattern("keyword.control.orbstimulus", {"at"}, part),
                       words_pattern("support.function.orbstimulus", stimulus_words(), part),
                       words_pattern("constant.language.orbstimulus", {"on", "off"}, part),
                       pattern("constant.numeric.orbstimulus",
                               "[-+]?\\d+(?:\\.\\d+)?(?:ms|s|min)?(?![A-Za-z0-9_])")}}};
  return grammar.dump(2) + "\n";
}

// ---- Vim

/// `syntax keyword GROUP WORD…`, a few words per line.
std::string vim_keywords(std::string_view group, const Words& words) {
  constexpr std::size_t a_line = 8;
  std::string out;
  for (std::size_t i = 0; i < words.size(); i += a_line) {
    const auto end =
        words.begin() + static_cast<std::ptrdiff_t>(std::min(i + a_line, words.size()));
    out += fmt::format("syntax keyword {} {}\n", group,
                       fmt::join(words.begin() + static_cast<std::ptrdiff_t>(i), end, " "));
  }
  return out;
}

std::string vim_head(std::string_view language) {
  return fmt::format("\" {}\n\" {}\nif exists('b:current_syntax')\n  finish\nendif\n"
                     "syntax case match\n",
                     language, generated);
}

std::string vim_links(std::string_view prefix,
                      const std::vector<std::pair<std::string_view, std::string_view>>& links) {
  std::string out;
  for (const auto& [group, target] : links)
    out += fmt::format("highlight default link {}{} {}\n", prefix, group, target);
  return out;
}

std::string basic_vim() {
  auto out = vim_head("orbBasic, the language of Sphero robots");
  out += vim_keywords("orbbasicControl", control_words());
  out += vim_keywords("orbbasicStatement", statement_words());
  out += vim_keywords("orbbasicFunction", function_words());
  out += vim_keywords("orbbasicSystem", variable_words());
  out += "syntax match orbbasicVariable /\\<\\a\\>/\n"
         "syntax match orbbasicNumber /\\<\\d\\+\\>/\n"
         "syntax match orbbasicLine /^\\s*\\d\\+/\n"
         "syntax match orbbasicOperator /[-+*\\/%&|{}=!<>?$]/\n"
         "syntax region orbbasicString start=/\"/ end=/\"/ oneline\n"
         "syntax match orbbasicComment /'.*$/\n";
  out += vim_links("orbbasic", {{"Control", "Conditional"},
                                {"Statement", "Statement"},
                                {"Function", "Function"},
                                {"System", "Special"},
                                {"Variable", "Identifier"},
                                {"Number", "Number"},
                                {"Line", "Label"},
                                {"Operator", "Operator"},
                                {"String", "String"},
                                {"Comment", "Comment"}});
  return out + "let b:current_syntax = 'orbbasic'\n";
}

std::string structured_vim() {
  auto out = vim_head("structured orbBasic for Sphero robots");
  out += "syntax case ignore\n"
         "syntax match orbstructuredName /\\<\\h\\w*\\>/\n";
  out += vim_keywords("orbstructuredControl", structured_control_words());
  out += vim_keywords("orbstructuredStatement", structured_statement_words());
  out += vim_keywords("orbstructuredFunction", function_words());
  out += vim_keywords("orbstructuredSystem", variable_words());
  out += "syntax match orbstructuredNumber "
         "/#\\x\\{6}\\>\\|\\<\\(0x\\x\\+\\|\\d\\+\\(\\.\\d\\+\\)\\?\\(ms\\|s\\|min\\)\\?\\)\\>/\n"
         "syntax match orbstructuredLabel /^\\s*\\h\\w*:/\n"
         "syntax match orbstructuredOperator /[-+*\\/%&|{}=!<>?$]/\n"
         "syntax region orbstructuredString start=/\"/ end=/\"/ oneline\n"
         "syntax match orbstructuredComment /'.*$/\n";
  out += vim_links("orbstructured", {{"Control", "Conditional"},
                                     {"Statement", "Statement"},
                                     {"Function", "Function"},
                                     {"System", "Special"},
                                     {"Name", "Identifier"},
                                     {"Number", "Number"},
                                     {"Label", "Label"},
                                     {"Operator", "Operator"},
                                     {"String", "String"},
                                     {"Comment", "Comment"}});
  return out + "let b:current_syntax = 'orbstructured'\n";
}

std::string macro_vim() {
  auto out = vim_head("macros of Sphero robots");
  out += vim_keywords("orbmacroCommand", macro_command_words());
  out += vim_keywords("orbmacroValue", macro_value_words());
  out += fmt::format("syntax match orbmacroDirective /^\\s*\\.\\({}\\)\\>/\n",
                     fmt::join(macro_directive_words(), "\\|"));
  out += "syntax match orbmacroOperand /\\<\\h\\w*\\ze\\s*=/\n"
         "syntax match orbmacroNumber "
         "/[-+]\\?\\<\\(0[xX]\\x\\+\\|\\d\\+\\(\\.\\d\\+\\)\\?\\)\\(ms\\|s\\|deg\\)\\?\\>/\n"
         "syntax match orbmacroEscape /\\\\./ contained\n"
         "syntax region orbmacroString start=/\"/ skip=/\\\\./ end=/\"/ oneline "
         "contains=orbmacroEscape\n"
         "syntax match orbmacroComment /#.*$/\n";
  out += vim_links("orbmacro", {{"Command", "Statement"},
                                {"Value", "Constant"},
                                {"Directive", "PreProc"},
                                {"Operand", "Identifier"},
                                {"Number", "Number"},
                                {"Escape", "SpecialChar"},
                                {"String", "String"},
                                {"Comment", "Comment"}});
  return out + "let b:current_syntax = 'orbmacro'\n";
}

std::string test_vim() {
  auto out = vim_head("tests of programs for Sphero robots");
  out += vim_keywords("orbtestKeyword", test_words());
  out += vim_keywords("orbtestExpectation", expectation_words());
  out += vim_keywords("orbtestStimulus", stimulus_words());
  out += "syntax match orbtestNumber "
         "/[-+]\\?\\<\\d\\+\\(\\.\\d\\+\\)\\?\\(ms\\|s\\|min\\|mm\\|cm\\|m\\|deg\\)\\?\\>/\n"
         "syntax match orbtestComment /#.*$/\n"
         "syntax match orbtestNumber /#\\x\\{6}\\>/\n"
         "syntax region orbtestString start=/\"/ end=/\"/ oneline\n"
         "syntax region orbtestString start=+\\%(print \\)\\@<=/+ skip=+\\\\/+ end=+/+ oneline\n";
  out += vim_links("orbtest", {{"Keyword", "Conditional"},
                               {"Expectation", "Statement"},
                               {"Stimulus", "Function"},
                               {"Number", "Number"},
                               {"String", "String"},
                               {"Comment", "Comment"}});
  return out + "let b:current_syntax = 'orbtest'\n";
}

std::string stimulus_vim() {
  auto out = vim_head("what the world does to a Sphero robot");
  out += vim_keywords("orbstimulusKeyword", {"at"});
  out += vim_keywords("orbstimulusEvent", stimulus_words());
  out += vim_keywords("orbstimulusValue", {"on", "off"});
  out += "syntax match orbstimulusNumber "
         "/[-+]\\?\\<\\d\\+\\(\\.\\d\\+\\)\\?\\(ms\\|s\\|min\\)\\?\\>/\n"
         "syntax match orbstimulusComment /#.*$/\n";
  out += vim_links("orbstimulus", {{"Keyword", "Conditional"},
                                   {"Event", "Function"},
                                   {"Value", "Constant"},
                                   {"Number", "Number"},
                                   {"Comment", "Comment"}});
  return out + "let b:current_syntax = 'orbstimulus'\n";
}

} // namespace

std::vector<SyntaxFile> syntax_files() {
  auto files = snippet_files();
  for (auto& file : tree_sitter_files())
    files.push_back(std::move(file));
  const std::vector<SyntaxFile> grammars{
      {"vscode/syntaxes/orbbasic.tmLanguage.json", basic_textmate()},
      {"vscode/syntaxes/orbstructured.tmLanguage.json", structured_textmate()},
      {"vscode/syntaxes/orbmacro.tmLanguage.json", macro_textmate()},
      {"vscode/syntaxes/orbtest.tmLanguage.json", test_textmate()},
      {"vscode/syntaxes/orbstimulus.tmLanguage.json", stimulus_textmate()},
      {"vim/syntax/orbbasic.vim", basic_vim()},
      {"vim/syntax/orbstructured.vim", structured_vim()},
      {"vim/syntax/orbmacro.vim", macro_vim()},
      {"vim/syntax/orbtest.vim", test_vim()},
      {"vim/syntax/orbstimulus.vim", stimulus_vim()}};
  files.insert(files.end(), grammars.begin(), grammars.end());
  return files;
}

} // namespace orb::editor
