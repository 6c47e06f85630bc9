#pragma once

#include "uploader/upload.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace orb::uploader {

using protocol::LinkError;
using protocol::Response;
using spec::ApiCommand;
using spec::Retry;
using spec::retry_of;

inline constexpr auto power_state_at =
    spec::answer_offset(ApiCommand::GetPowerState, "power state");
inline constexpr auto rx_good_at =
    spec::answer_offset(ApiCommand::PerformLevel2Diagnostics, "Rx_Good");

inline bool is_ok(const Response& response) {
  return response.code == static_cast<std::uint8_t>(spec::ResponseCode::Ok);
}

inline double seconds(Duration duration) {
  return static_cast<double>(duration.count()) / 1e9;
}

inline bool is_program(Route route) {
  return route == Route::Ram || route == Route::RamThenFlash || route == Route::FlashDirectly;
}

/// `RAM holds part of the program`: what is where, for the end of a message.
inline std::string describe(Content content, Route route) {
  const auto committed = route == Route::RamThenFlash;
  const std::string_view place = route == Route::FlashDirectly ? "flash" : "RAM";
  if (!is_program(route)) {
    switch (content) {
    case Content::Unchanged: return "the ball's macros are unchanged";
    case Content::ErasedOrUnchanged: return "the ball's macros may have been cleared";
    case Content::Erased: return "the ball's macros have been cleared";
    case Content::Incomplete: return "the ball may hold a part of the macro";
    case Content::Uncommitted:
    case Content::Unconfirmed: return "the macro may or may not be there";
    case Content::Stored: return "the macro is stored";
    }
  }
  const auto tail = committed ? "; the program in flash is unchanged" : "";
  switch (content) {
  case Content::Unchanged: return "the ball's programs are unchanged";
  case Content::ErasedOrUnchanged:
    return fmt::format("the program in {} is erased or unchanged{}", place, tail);
  case Content::Erased: return fmt::format("the program in {} is erased{}", place, tail);
  case Content::Incomplete: return fmt::format("the program in {} is incomplete{}", place, tail);
  case Content::Uncommitted: return "the program is in RAM, the one in flash is unchanged";
  case Content::Unconfirmed:
    return committed ? "the program in flash is the old one or the new one"
                     : fmt::format("whether the program in {} is complete is not known", place);
  case Content::Stored:
    return fmt::format("the program is stored in {}", committed ? "flash" : place);
  }
  return {};
}

inline bool is_interruption(const NoAnswer& failure) {
  return failure.kind == NoAnswer::Kind::Link && failure.link.kind == LinkError::Kind::Interrupted;
}

inline Report refused(ApiCommand command, const Response& response, Content content,
                      std::string_view state) {
  const auto* row = spec::find_response(response.code);
  return {Report::Kind::Refused, content,
          fmt::format("the ball refused {}: {}{}{}{}", spec::info(command).name,
                      describe_code(response.code), state,
                      row == nullptr || row->remedy.empty() ? "" : "; ",
                      row == nullptr ? "" : row->remedy),
          response.code};
}

/// No answer, or none but "damaged".
inline Report lost(const Session& session, ApiCommand command, const NoAnswer& failure,
                   Content content, std::string_view state) {
  const auto name = spec::info(command).name;
  if (is_interruption(failure))
    return {Report::Kind::Interrupted, content, fmt::format("interrupted{}", state), 0};
  return {content == Content::Unconfirmed ? Report::Kind::Unknown : Report::Kind::LinkLost, content,
          failure.kind == NoAnswer::Kind::Link
              ? fmt::format("link lost during {}: {}{}", name, failure.link.message, state)
              : fmt::format("the ball stopped answering: nothing to {} within {:g} s{}", name,
                            seconds(session.budgets().answer), state),
          0};
}

/// What a second answer means: a piece stored twice, or nothing, as for a start, of which the ball
/// refuses the second.
enum class Duplicates : std::uint8_t { Matter, DoNotMatter };

/// Sends one packet that must be carried out exactly once. `data` makes it for the sequence number
/// that comes next, so that a resend can be cut differently. An answer other than OK is returned
/// only where sending again does not help.
template <class MakeData>
tl::expected<std::optional<Response>, NoAnswer> inline send_once(Session& session,
                                                                 ApiCommand command,
                                                                 Duplicates duplicates,
                                                                 const MakeData& data) {
  for (int resend = 0; resend <= session.budgets().resends; ++resend) {
    const auto answer = session.exchange(command, data());
    if (!answer && answer.error().kind == NoAnswer::Kind::Link)
      return tl::unexpected(answer.error());
    if (!answer || (duplicates == Duplicates::Matter && session.duplicate_seen()))
      return std::nullopt;
    if (is_transient(answer->code)) {
      if (const auto waited = session.listen(session.now() + session.budgets().backoff(resend + 1));
          !waited)
        return tl::unexpected(waited.error());
    } else if (retry_of(answer->code) != Retry::SameAgain) {
      return *answer;
    }
  }
  return std::nullopt;
}

/// Whether a message shows that a program runs, or ran until now.
inline bool is_sign_of_life(const protocol::Async& message) {
  return message.id == static_cast<std::uint8_t>(spec::AsyncId::BasicPrint) ||
         message.id == static_cast<std::uint8_t>(spec::AsyncId::BasicErrorText) ||
         message.id == static_cast<std::uint8_t>(spec::AsyncId::BasicError);
}

/// Carries a plan out and knows what is on the ball at each moment.
class Upload {
public:
  Upload(Session& session, const Plan& plan, Progress& progress);

  /// Walks the steps, from the first again where the content may have arrived otherwise than once.
  Report run(std::string done);

private:
  /// What came of a step: a report where the upload ends with it.
  enum class Sent : std::uint8_t { Whole, StartOver };
  using Ended = tl::expected<Sent, Report>;
  using Answer = tl::expected<std::optional<Response>, NoAnswer>;

  Ended carry_out(const Step& step);

  std::optional<Report> begin_again();

  // What is told.

  void show(Stage stage);

  std::string state() const { return "; " + describe(content_, plan_.route); }

  Report refuse(ApiCommand command, const Response& response) const;

  Report lose(ApiCommand command, const NoAnswer& failure) const;

  // Before the content.

  /// Sends a harmless command until it is answered.
  Ended ask(const Step& step, Content if_refused);

  Ended erase(const Step& step);

  /// How many whole packets the ball says it has received, and how many we know of.
  struct Count {
    std::uint32_t received = 0;
    std::uint32_t arrived = 0;

    bool fits(const Count& later) const {
      return later.received - received == later.arrived - arrived;
    }
  };

  /// Nothing where the ball does not say.
  tl::expected<std::optional<Count>, NoAnswer> ask_count(ApiCommand command);

  Ended count(const Step& step);

  /// Whether the ball has received as many packets as it has answered since it was asked first. The
  /// first time that it has not, it is asked until two counts fit: a ball that counts otherwise
  /// than we do is not asked any more.
  tl::expected<bool, NoAnswer> count_fits(ApiCommand command);

  // The content.

  Ended append(const Step& step);

  /// Sends the next piece, of a stream until the buffer of the ball has room for it.
  Answer offer(const Step& step, std::size_t& sent);

  /// A piece without an answer: what is stored is not known. A program is sent again from the
  /// start; a macro is thrown away, as it may be playing.
  Ended unanswered(ApiCommand command, const Answer& answer);

  /// The report, after a macro that has arrived in part has been aborted.
  Report stopped(Report report);

  /// Waits until all answers of the ball have come through. A second one among them, or another
  /// number of packets in the ball than were answered, says that a piece may be there twice.
  Ended barrier(const Step& step);

  Ended doubled();

  Ended store(const Step& step);

  Ended save_user_macro(const Step& step);

  // After the content.

  Ended start(const Step& step);

  /// Whether what was started without an answer shows that it runs.
  bool runs(const Step& step);

  Session& session_;
  const Plan& plan_;
  Progress& progress_;
  Status status_;
  Content content_ = Content::Unchanged;
  std::size_t uncounted_ = 0;   ///< pieces of which only the answers are known
  std::optional<Count> before_; ///< the content
  enum class Trust : std::uint8_t { NotYet, Yes, No } trust_ = Trust::NotYet; ///< in its counting
};

} // namespace orb::uploader
