#pragma once

#include "base/diagnostic.h"
#include "base/slots.h"
#include "base/source.h"
#include "base/time.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb {

/// The value of a slot.
struct SlotValue {
  Span span{};           ///< empty if the slot is absent
  std::string text{};    ///< without quotes; for an axis, `x` or `y`
  std::size_t which = 0; ///< choice: index of the word; axis: the sign; time: 1 if written as its
                         ///< word; match: 0 whole text, 1 part, 2 pattern
  double least = 0;      ///< range: lower end; place: x
  double most = 0;       ///< range: upper end; place: y; otherwise the number
  Duration from{};       ///< start of a time span
  Duration to{};         ///< end of a time span, or a single time

  bool is_given() const { return span.size() > 0; }
  std::int64_t whole() const { return static_cast<std::int64_t>(most); }
};

/// Reads one line from left to right; `#` begins a comment. Only the first error is reported: after
/// it, every function returns a harmless value and adds no finding. Large because each kind of
/// value has its own reader.
class Cursor {
public:
  /// `syntax` reports missing or unexpected words, `value` reports bad values.
  Cursor(const Source& source, std::uint32_t line, std::vector<Diagnostic>& diagnostics,
         const Rule& syntax, const Rule& value);
  /// Reads without reporting findings.
  Cursor(const Source& source, std::uint32_t line);

  bool failed() const { return failed_; }
  /// True if only whitespace and a comment remain.
  bool at_end();
  /// The text from `from` to the current position, trimmed.
  Span span_from(std::uint32_t from) const;
  std::uint32_t offset();
  /// The next word, up to whitespace, without consuming it.
  std::string_view peek();
  Span peek_span();
  char peek_char();

  std::string_view word();
  /// Consumes the rest of the line.
  Span take_rest();
  bool take_word(std::string_view wanted);
  /// Reads a quoted text and returns it without the quotes.
  std::string quoted();

  /// Reads a value and the word in front of it.
  SlotValue read(const Slot& slot);
  /// Reads one value per slot; optional slots may come in any order.
  std::vector<SlotValue> read(std::span<const Slot> slots);

  /// Reports an error at the current word.
  void fail(const Rule& rule, Message message, Message help = {});
  void fail_at(Span span, const Rule& rule, Message message, Message help = {});

private:
  /// Reports what the value at the current position must be.
  void wrong(const Slot& slot, Message problem);
  void read_value(const Slot& slot, SlotValue& value);
  void read_number(const Slot& slot, SlotValue& value);
  void read_length(const Slot& slot, SlotValue& value);
  void read_range(const Slot& slot, SlotValue& value);
  void read_time(const Slot& slot, SlotValue& value);
  void read_times(const Slot& slot, SlotValue& value);
  void read_axis(const Slot& slot, SlotValue& value);
  void read_match(SlotValue& value);
  void read_choice(const Slot& slot, SlotValue& value);
  double read_coordinate(std::string_view axis);
  std::string slashed();
  /// Consumes the word or sign in front of a slot; returns true if it was there.
  bool take_before(const Slot& slot);
  bool begins(const Slot& slot);

  std::optional<double> digits();
  std::string_view unit_word();
  bool take(char wanted);
  void skip_blanks();
  void go_back_to(std::uint32_t offset) { at_ = offset - begin_; }

  std::string_view text_;
  std::uint32_t begin_;
  std::size_t at_ = 0;
  std::vector<Diagnostic>* diagnostics_ = nullptr;
  const Rule* syntax_ = nullptr;
  const Rule* value_ = nullptr;
  bool failed_ = false;
};

} // namespace orb
