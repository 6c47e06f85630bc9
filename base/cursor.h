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

/// What stands in a slot.
struct SlotValue {
  Span span{};           ///< empty: nothing does
  std::string text{};    ///< without quotes; of an axis `x` or `y`
  std::size_t which = 0; ///< the word of a choice; the sign of an axis; of a time 1 for its word;
                         ///< of a match 0 for the whole, 1 for a part, 2 for a pattern
  double least = 0;      ///< of a range; of a place x
  double most = 0;       ///< of a range; any other number; of a place y
  Duration from{};       ///< of a time span
  Duration to{};         ///< of a time span; any other time

  bool is_given() const { return span.size() > 0; }
  std::int64_t whole() const { return static_cast<std::int64_t>(most); }
};

/// Reads one line from left to right; `#` begins a comment. The first thing that is wrong is told;
/// after that every function returns a value that does no harm and says nothing more.
class Cursor {
public:
  /// The rules are for what is missing or unexpected, and for values.
  Cursor(const Source& source, std::uint32_t line, std::vector<Diagnostic>& diagnostics,
         const Rule& syntax, const Rule& value);
  /// Only looks: nothing is told.
  Cursor(const Source& source, std::uint32_t line);

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
  /// What stands here to the end of the line.
  Span take_rest();
  bool take_word(std::string_view wanted);
  /// A text in quotes, without them.
  std::string quoted();

  /// A value, with the word in front of it.
  SlotValue read(const Slot& slot);
  /// One for each slot; those that may lack in any order.
  std::vector<SlotValue> read(std::span<const Slot> slots);

  /// Tells what is wrong with what stands here.
  void fail(const Rule& rule, Message message, Message help = {});
  void fail_at(Span span, const Rule& rule, Message message, Message help = {});

private:
  /// Tells what the value that stands here must be.
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
  /// Whether the word, or sign, in front of a slot stands here, and takes it.
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
