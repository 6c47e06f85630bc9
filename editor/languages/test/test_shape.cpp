// The look and the links of test files and stimulus scripts.

#include "editor/languages/test/test_names.h"
#include "editor/text_places.h"
#include "testing/suite.h"

#include <algorithm>

namespace orb::editor {
namespace {

void color_test_word(Palette& palette, Span span, std::string_view text, bool is_first) {
  static const auto joints = testing::operand_words();
  const bool joins = std::find(joints.begin(), joints.end(), text) != joints.end();
  if ((is_first && row_of(testing::line_words, text) != nullptr) ||
      row_of(testing::when_words, text) != nullptr ||
      row_of(testing::join_words, text) != nullptr || joins)
    palette.add(span, Color::Keyword);
  else if (row_of(testing::expectations, text) != nullptr ||
           row_of(vm::stimulus_words, text) != nullptr)
    palette.add(span, Color::Function, Robots);
}

void color_lines(Palette& palette, const Source& source) {
  for (std::uint32_t line = 1; line <= source.line_count(); ++line) {
    bool is_first = true;
    for (const auto& token : tokens_of_line(source, line, test_lexis)) {
      color_token(palette, token);
      if (token.kind == TokenKind::Word)
        color_test_word(palette, token.span, source.text(token.span), is_first);
      is_first = false;
    }
  }
}

/// The files that a test file names.
std::vector<testing::Named> files_in(const testing::TestFile& file) {
  std::vector<testing::Named> names;
  for (const auto* name : {&file.program, &file.course})
    if (*name)
      names.push_back(**name);
  names.insert(names.end(), file.with.begin(), file.with.end());
  return names;
}

std::vector<Colored> test_colors(const Source& source, const LanguageOptions&) {
  const auto file = testing::parse(source);
  Palette palette;
  for (const auto& name : files_in(file))
    palette.add(name.span, Color::String);
  for (const auto& test : file.tests)
    for (const auto& one : test.expectations) {
      if (!one.name.text.empty())
        palette.add(one.name.span, Color::Variable);
      if (one.match != testing::Match::Pattern)
        continue;
      const auto text = source.text(one.span);
      const auto begin = text.find('/');
      const auto end = text.rfind('/');
      if (begin != text.npos && end > begin)
        palette.add({one.span.begin + static_cast<std::uint32_t>(begin),
                     one.span.begin + static_cast<std::uint32_t>(end) + 1},
                    Color::Pattern);
    }
  color_lines(palette, source);
  return palette.take();
}

std::vector<Colored> stimulus_colors(const Source& source, const LanguageOptions&) {
  Palette palette;
  color_lines(palette, source);
  return palette.take();
}

std::vector<Fold> test_folds(const Source& source) {
  const auto file = testing::parse(source);
  auto folds = comment_folds(source, test_lexis.comment);
  for (std::size_t i = 0; i < file.tests.size(); ++i)
    if (file.tests[i].name.span.size() > 0)
      add_fold(folds, source, file.tests[i].line,
               i + 1 < file.tests.size() ? file.tests[i + 1].line - 1 : source.line_count());
  return folds;
}

std::vector<Fold> stimulus_folds(const Source& source) {
  return comment_folds(source, test_lexis.comment);
}

std::vector<Span> test_around(const Source& source, std::uint32_t offset) {
  auto spans = tokens_around(source, offset);
  for (const auto& symbol : test_service.outline(source))
    spans.push_back(symbol.span);
  return spans;
}

std::optional<Signature> stimulus_signature(const Source& source, std::uint32_t offset,
                                            const LanguageOptions&) {
  const auto before = spot_at(source, offset).before;
  const std::size_t at = !before.empty() && before[0] == "at" ? 2 : 0;
  const auto* row = before.size() > at ? row_of(vm::stimulus_words, before[at]) : nullptr;
  if (row == nullptr)
    return std::nullopt;
  return row_signature(*row, reference::stimulus_section(), stimulus_language_id);
}

std::optional<Signature> test_signature(const Source& source, std::uint32_t offset,
                                        const LanguageOptions& options) {
  const auto before = spot_at(source, offset).before;
  if (before.size() > 1 && (before[0] == "expect" || before[0] == "never"))
    if (const auto* row = row_of(testing::expectations, before[1]))
      return row_signature(*row, reference::expectations_section(), test_language_id);
  if (auto found = stimulus_signature(source, offset, options))
    return found;
  const auto* row = before.empty() ? nullptr : row_of(testing::line_words, before[0]);
  if (row == nullptr)
    return std::nullopt;
  return row_signature(*row, reference::test_lines_section(), test_language_id);
}

std::vector<Link> test_links(const Source& source) {
  const auto folder = path_of_uri(source.name());
  std::vector<Link> links;
  for (const auto& name : files_in(testing::parse(source)))
    links.push_back({name.span, structured::resolve_path(folder, name.text)});
  return links;
}

std::vector<Lens> test_lenses(const Source& source) {
  const auto file = testing::parse(source);
  std::vector<Lens> lenses;
  if (file.tests.empty())
    return lenses;
  lenses.push_back({{0, end_of_line(source, 0)}, Lens::Deed::RunTest, ""});
  for (const auto& test : file.tests) {
    if (test.name.span.size() == 0)
      continue;
    lenses.push_back({test.name.span, Lens::Deed::RunTest, test.name.text});
    lenses.push_back({test.name.span, Lens::Deed::DebugTest, test.name.text});
  }
  return lenses;
}

} // namespace

const LanguageShape test_shape = {test_colors,    test_folds, test_around,
                                  test_signature, test_links, test_lenses};

const LanguageShape stimulus_shape = {stimulus_colors, stimulus_folds, tokens_around,
                                      stimulus_signature};

} // namespace orb::editor
