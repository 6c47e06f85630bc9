#include "testing/text/pattern.h"

// PCRE2 documents its options for ECMAScript, counts its steps, and never recurses on the caller's
// stack. std::regex can take exponential time and recurses; RE2 lacks `(?=` and `\1`, which
// ECMAScript has.
#define PCRE2_CODE_UNIT_WIDTH 8
#include <pcre2.h>

#include <array>
#include <utility>

namespace orb::testing {
namespace {

// Gives up after some milliseconds.
constexpr std::uint32_t most_steps = 100'000;
constexpr std::uint32_t most_heap_kib = 1024;
constexpr std::uint32_t deepest_parentheses = 50;

constexpr std::uint32_t like_ecmascript = PCRE2_ALT_BSUX | PCRE2_ALLOW_EMPTY_CLASS |
                                          PCRE2_MATCH_UNSET_BACKREF | PCRE2_DOLLAR_ENDONLY |
                                          PCRE2_NEVER_BACKSLASH_C;

struct Free {
  void operator()(pcre2_code* code) const { pcre2_code_free(code); }
  void operator()(pcre2_compile_context* context) const { pcre2_compile_context_free(context); }
  void operator()(pcre2_match_context* context) const { pcre2_match_context_free(context); }
  void operator()(pcre2_match_data* data) const { pcre2_match_data_free(data); }
};

template <class Of>
using Owned = std::unique_ptr<Of, Free>;

PCRE2_SPTR units(std::string_view text) {
  return reinterpret_cast<PCRE2_SPTR>(text.data());
}

} // namespace

struct Pattern::Code {
  Owned<pcre2_code> code;
  Owned<pcre2_match_context> context;
};

Pattern::Pattern(std::unique_ptr<Code> code) : code_(std::move(code)) {}
Pattern::Pattern(Pattern&&) noexcept = default;
Pattern& Pattern::operator=(Pattern&&) noexcept = default;
Pattern::~Pattern() = default;

tl::expected<Pattern, Pattern::Problem> Pattern::compile(std::string_view text) {
  const Owned<pcre2_compile_context> limits(pcre2_compile_context_create(nullptr));
  pcre2_set_parens_nest_limit(limits.get(), deepest_parentheses);
  int error = 0;
  PCRE2_SIZE at = 0;
  Owned<pcre2_code> code(
      pcre2_compile(units(text), text.size(), like_ecmascript, &error, &at, limits.get()));
  if (!code) {
    std::array<PCRE2_UCHAR, 256> words{}; // PCRE2's messages are shorter
    pcre2_get_error_message(error, words.data(), words.size());
    return tl::unexpected(Problem{at, reinterpret_cast<const char*>(words.data())});
  }
  Owned<pcre2_match_context> context(pcre2_match_context_create(nullptr));
  pcre2_set_match_limit(context.get(), most_steps);
  pcre2_set_heap_limit(context.get(), most_heap_kib);
  return Pattern(std::make_unique<Code>(Code{std::move(code), std::move(context)}));
}

Pattern::Found Pattern::search(std::string_view line) const {
  const Owned<pcre2_match_data> match(pcre2_match_data_create(1, nullptr));
  const int found = pcre2_match(code_->code.get(), units(line), line.size(), 0, 0, match.get(),
                                code_->context.get());
  if (found >= 0)
    return Found::Yes;
  return found == PCRE2_ERROR_NOMATCH ? Found::No : Found::GaveUp;
}

} // namespace orb::testing
