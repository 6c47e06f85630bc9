#include "cli/lsp_language.h"
namespace orb::cli {
namespace {
std::vector<Diagnostic> check(const Source&, const LanguageOptions&) {
  return {};
}
std::optional<Hover> hover(const Source&, std::uint32_t) {
  return {};
}
Suggestions suggest(const Source&, std::uint32_t) {
  return {};
}
std::vector<Symbol> outline(const Source&) {
  return {};
}
Occurrences occurrences(const Source&, std::uint32_t) {
  return {};
}
tl::expected<std::vector<Edit>, std::string> rename(const Source&, std::uint32_t,
                                                    std::string_view) {
  return {};
}
std::optional<std::string> format(const Source&) {
  return {};
}
std::vector<Rewrite> rewrites(const Source&, const LanguageOptions&) {
  return {};
}
} // namespace
const LanguageService macro_service = {check,       hover,  suggest, outline,
                                       occurrences, rename, format,  rewrites};
} // namespace orb::cli
