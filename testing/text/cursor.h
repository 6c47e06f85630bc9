#pragma once

#include "base/diagnostic.h"
#include "base/source.h"
#include "base/time.h"
#include "base/units.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace orb::testing {

/// The units of lengths in test files.
inline constexpr std::array length_units{unit::mm, unit::cm, unit::m};

/// Reads one line of a test file from left to right. The first thing that is wrong is told; after
/// that every function returns a value that does no harm and says nothing more.
class Cursor {
public:
  Cursor(const Source& source, std::uint32_t line, std::vector<Diagnostic>& diagnostics);

  bool failed() const { return failed_; }
  /// Whether nothing is left but blanks and a comment.
  bool at_end();
  /// The text from `from` to here, without blanks at its ends.
  Span span_from(std::uint32_t from) const;
  std::uint32_t offset();
  /// What stands here up to the next blank, without taking it.
  std::string_view peek();
  Span peek_span();
  char peek_char();

  std::string_view word();
  /// What stands here up to the next blank, where `#` and six hexadecimal digits are a colour.
  std::string_view color_word();
  /// From a `#` that stands here up to the next blank; else empty.
  Span hash_span();
  std::string_view text_of(Span span) const {
    return text_.substr(span.begin - begin_, span.size());
  }
  /// Takes so many bytes.
  void skip(std::size_t bytes) { at_ += bytes; }
  /// Takes the character, or tells that it is missing.
  void character(char wanted, std::string_view help);
  bool take(char wanted);
  bool take_word(std::string_view wanted);
  /// A text in quotes, without them.
  std::string quoted();
  /// What stands between slashes; `\/` is a slash.
  std::string slashed();
  /// A file's name: a word, or a text in quotes.
  std::string file_name();

  double number(std::string_view what);
  std::int64_t whole(std::string_view what, std::int64_t least, std::int64_t greatest);
  /// `12cm`, in centimetres.
  double length();
  struct Range {
    double least = 0;
    double most = 0;
  };
  /// `90cm..110cm` or `90..110cm`.
  Range lengths();
  /// The same in cm/s.
  Range speeds();
  Range numbers(std::string_view what, std::int64_t least, std::int64_t greatest);
  Duration time();
  std::pair<Duration, Duration> times();

  /// Tells what is wrong with what stands here.
  void fail(const Rule& rule, std::string message, std::string help = {});
  void fail_at(Span span, const Rule& rule, std::string message, std::string help = {});

private:
  std::optional<double> digits();
  std::string_view unit_word();
  Range range(std::span<const Unit> units, const Unit& in, std::string_view what,
              std::string_view example);
  void skip_blanks();

  std::string_view text_;
  std::uint32_t begin_;
  std::size_t at_ = 0;
  std::vector<Diagnostic>* diagnostics_;
  bool failed_ = false;
};

} // namespace orb::testing
