#include "structured/meaning/unknown_names.h"

#include "base/fixes.h"
#include "base/meant.h"
#include "base/text/suggest.h"
#include "structured/text/foreign_words.h"
#include "structured/text/link_blocks.h"
#include "structured/text/rules.h"
#include "structured/text/structured_words.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace orb::structured {
namespace {

/// True if a name may be declared in a part that could not be read.
bool is_incomplete(const Program& program) {
  return std::any_of(program.diagnostics.begin(), program.diagnostics.end(),
                     [](const Diagnostic& one) {
                       return one.rule == &rules::MissingFile || one.rule == &rules::BadMacroFile;
                     }) ||
         std::any_of(program.statements.begin(), program.statements.end(),
                     [](const Statement& one) { return declares(one.meant); });
}

} // namespace

UnknownNames::UnknownNames(Program& program, const Names& names)
    : program_(program), names_(names), incomplete_(is_incomplete(program)),
      broken_(any_error(program.diagnostics)) {}

Diagnostic& UnknownNames::add(const Rule& rule, Span span, Message message, Message help) {
  return program_.diagnostics.emplace_back(
      finding(rule, span, std::move(message), std::move(help)));
}

void UnknownNames::report(const Node& node, bool needs_declaration) {
  if (broken_ && !needs_declaration)
    return; // a line that does not parse may assign it
  if (const auto name = static_cast<std::uint32_t>(node.value); !said_.insert(name).second)
    return; // already reported at its first use
  const Span span{
      node.span.begin,
      node.span.begin +
          static_cast<std::uint32_t>(program_.name(static_cast<std::uint32_t>(node.value)).size())};
  if (span.size() > 1 && report_foreign(span, Stands::Inside)) // a single letter is a name
    return;
  if (const auto text = std::string(program_.text_of(span)); find_colour(text)) {
    add(rules::UnknownName, span, texts::IsAColour(text), texts::OnlyAColour("RGB", "RGB " + text));
    return;
  }
  std::vector<std::string_view> candidates;
  for (const auto& symbol : names_.symbols)
    candidates.push_back(program_.name(symbol.name));
  for (const auto& row : spec::variables)
    candidates.push_back(row.word);
  suggest(span, candidates,
          node.kind == NodeKind::Name      ? texts::NeverAssigned
          : node.kind == NodeKind::Element ? texts::NotAnArray
                                           : texts::NotAFunction);
}

void UnknownNames::report_colour(Span span) {
  const auto names = colour_names();
  const auto name = program_.text_of(span);
  add(rules::UnknownName, span, texts::NeitherColourNorVariable(name),
      meant_or(name, names, texts::ColoursAre(fmt::format("{}", fmt::join(names, ", ")))));
}

void UnknownNames::report_word(Span span) {
  if (report_foreign(span, Stands::First))
    return;
  std::vector<std::string_view> candidates;
  for (const auto& symbol : names_.symbols)
    if (symbol.kind == SymbolKind::Sub)
      candidates.push_back(program_.name(symbol.name));
  for (const auto& row : spec::statements)
    candidates.push_back(row.word);
  for (const auto& row : keywords)
    candidates.push_back(row.word);
  suggest(span, candidates, texts::NeitherStatementNorSub);
}

bool UnknownNames::report_foreign(Span span, Stands stands) {
  auto known = name_foreign(program_, span, stands);
  if (known && !incomplete_)
    program_.diagnostics.push_back(*std::move(known));
  return known.has_value();
}

void UnknownNames::suggest(Span span, const std::vector<std::string_view>& candidates,
                           const Row<Hole::Code>& unknown) {
  if (incomplete_)
    return;
  constexpr std::size_t most = 64; // more suggestions would take too long
  const auto name = std::string(program_.text_of(span));
  auto& d = add(rules::UnknownName, span, unknown(name));
  if (++unknown_ > most)
    return;
  if (const auto meant = closest(name, candidates)) {
    d.help = texts::DidYouMean(*meant);
    d.fix = single_fix(texts::Write(*meant), span, *meant, Safety::Unsafe);
  }
}

} // namespace orb::structured
