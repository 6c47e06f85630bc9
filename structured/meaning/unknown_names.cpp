#include "structured/meaning/unknown_names.h"

#include "base/text/suggest.h"
#include "structured/text/blocks.h"
#include "structured/text/messages.h"
#include "structured/text/rules.h"
#include "structured/text/words.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace orb::structured {
namespace {

/// Whether a name may be declared where it could not be read.
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

Diagnostic& UnknownNames::add(const Rule& rule, Span span, std::string message, std::string help) {
  return program_.diagnostics.emplace_back(
      finding(rule, span, std::move(message), std::move(help)));
}

void UnknownNames::report(const Node& node, bool needs_declaration) {
  if (broken_ && !needs_declaration)
    return; // a line that does not parse may assign it
  if (const auto name = static_cast<std::uint32_t>(node.value); !said_.insert(name).second)
    return; // said where it stands first
  const Span span{
      node.span.begin,
      node.span.begin +
          static_cast<std::uint32_t>(program_.name(static_cast<std::uint32_t>(node.value)).size())};
  if (span.size() > 1 && report_foreign(span, repair::Where::Inside)) // a letter is a name
    return;
  if (find_colour(program_.text_of(span))) {
    add(rules::UnknownName, span, fmt::format("`{}` is a colour", program_.text_of(span)),
        fmt::format("use only a colour after `RGB`: `RGB {}`", program_.text_of(span)));
    return;
  }
  std::vector<std::string_view> candidates;
  for (const auto& symbol : names_.symbols)
    candidates.push_back(program_.name(symbol.name));
  for (const auto& row : spec::variables)
    candidates.push_back(row.word);
  suggest(span, candidates,
          node.kind == NodeKind::Name      ? "is never assigned"
          : node.kind == NodeKind::Element ? "is not an array"
                                           : "is not a function");
}

void UnknownNames::report_colour(Span span) {
  const auto names = colour_names();
  const auto name = program_.text_of(span);
  add(rules::UnknownName, span, fmt::format("`{}` is neither a colour nor a variable", name),
      did_you_mean(name, names,
                   fmt::format("colours are {}, or `#FF8000`", fmt::join(names, ", "))));
}

void UnknownNames::report_word(Span span) {
  if (report_foreign(span, repair::Where::Line))
    return;
  std::vector<std::string_view> candidates;
  for (const auto& symbol : names_.symbols)
    if (symbol.kind == SymbolKind::Sub)
      candidates.push_back(program_.name(symbol.name));
  for (const auto& row : spec::statements)
    candidates.push_back(row.word);
  for (const auto& row : keywords)
    candidates.push_back(row.word);
  suggest(span, candidates, "is neither a statement nor a sub");
}

bool UnknownNames::report_foreign(Span span, repair::Where where) {
  auto known = foreign(program_, span, where);
  if (known && !incomplete_)
    program_.diagnostics.push_back(*std::move(known));
  return known.has_value();
}

void UnknownNames::suggest(Span span, const std::vector<std::string_view>& candidates,
                           std::string_view what) {
  if (incomplete_)
    return;
  constexpr std::size_t most = 64; // a suggestion for each of very many would take too long
  const auto name = std::string(program_.text_of(span));
  auto& d = add(rules::UnknownName, span, fmt::format("`{}` {}", name, what));
  if (++unknown_ > most)
    return;
  if (const auto meant = closest(name, candidates)) {
    d.help = fmt::format("did you mean `{}`?", *meant);
    d.fix = Fix{fmt::format("write `{}`", *meant), {Edit{span, *meant}}, Safety::Unsafe};
  }
}

} // namespace orb::structured
