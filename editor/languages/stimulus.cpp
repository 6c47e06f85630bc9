// Editor support for stimulus scripts.

#include "vm/stimulus.h"
#include "editor/languages/test/test_names.h"
#include "testing/text/layout.h"

namespace orb::editor {
namespace {

std::vector<Diagnostic> check(const Source& source, const LanguageOptions&) {
  return vm::parse_stimulus(source).diagnostics;
}

std::optional<Hover> hover(const Source& source, std::uint32_t offset, const LanguageOptions&) {
  const auto spot = spot_at(source, offset);
  auto text = is_stimulus_place(spot)
                  ? find_markdown(reference::stimulus_section(), spot.word, stimulus_language_id)
                  : std::nullopt;
  return text ? std::optional(Hover{spot.span, *std::move(text)}) : std::nullopt;
}

Suggestions suggest(const Source& source, std::uint32_t offset, const LanguageOptions&) {
  const auto spot = spot_at(source, offset);
  Suggestions out{{spot.span.begin, offset}, {}};
  if (is_stimulus_place(spot))
    suggest_rows(out, vm::stimulus_words, reference::stimulus_section(), stimulus_language_id);
  return out;
}

std::vector<Symbol> outline(const Source&) {
  return {};
}

std::optional<std::string> format(const Source& source) {
  return testing::layout(source.text());
}

tl::expected<Renaming, std::string> rename(const Source&, std::uint32_t, std::string_view,
                                           const LanguageOptions&) {
  return tl::unexpected(std::string("nothing in a stimulus script can be renamed"));
}

} // namespace

const LanguageService stimulus_service = {
    check,  hover,  suggest,           outline,        nothing::occurrences,
    rename, format, nothing::rewrites, &stimulus_shape};

} // namespace orb::editor
