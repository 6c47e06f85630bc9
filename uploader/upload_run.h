#pragma once

#include "uploader/upload.h"

namespace orb::uploader {

using protocol::LinkError;
using protocol::Response;
using spec::ApiCommand;

inline bool is_ok(const Response& response) {
  return response.code == static_cast<std::uint8_t>(spec::ResponseCode::Ok);
}

inline bool is_interruption(const NoAnswer& failure) {
  return failure.kind == NoAnswer::Kind::Link && failure.link.kind == LinkError::Kind::Interrupted;
}

/// Returns what the ball refused and why, what is on it now (`state`) and the remedy.
Report refused(ApiCommand command, const Response& response, Content content,
               std::string_view state);

/// Returns the report for a missing answer or only "damaged" ones; Kind::Interrupted if the user
/// stopped it.
Report lost(const Session& session, ApiCommand command, const NoAnswer& failure, Content content,
            std::string_view state);

/// Executes a plan and tracks what is on the ball.
class Upload {
public:
  Upload(Session& session, const Plan& plan, Progress& progress);

  /// Executes the steps. Restarts from the first if the content may not have arrived exactly once.
  Report run(std::string done);

private:
  /// Result of a step; a report ends the upload.
  enum class Sent : std::uint8_t { Whole, StartOver };
  using Ended = tl::expected<Sent, Report>;
  using Answer = tl::expected<std::optional<Response>, NoAnswer>;

  Ended carry_out(const Step& step);

  std::optional<Report> begin_again();

  // Reports.

  void show(Stage stage);

  std::string state() const;

  Report refuse(ApiCommand command, const Response& response) const;

  Report lose(ApiCommand command, const NoAnswer& failure) const;

  // Before the content.

  /// Repeats a harmless command until answered.
  Ended ask(const Step& step, Content if_refused);

  Ended erase(const Step& step);

  /// Packets received by the ball's count, and packets known to have arrived.
  struct Count {
    std::uint32_t received = 0;
    std::uint32_t arrived = 0;

    bool fits(const Count& later) const {
      return later.received - received == later.arrived - arrived;
    }
  };

  /// Returns nullopt if the ball does not count.
  tl::expected<std::optional<Count>, NoAnswer> ask_count(ApiCommand command);

  Ended count(const Step& step);

  /// Returns true if the ball has received as many packets as it has answered since the first
  /// count. At the first mismatch it counts until two counts fit; a ball that counts differently is
  /// not asked again.
  tl::expected<bool, NoAnswer> count_fits(ApiCommand command);

  // The content.

  Ended append(const Step& step);

  /// Sends the next piece. For a stream, repeats until the ball's buffer has room.
  Answer offer(const Step& step, std::size_t& sent);

  /// Handles a piece without an answer: the stored content is uncertain. A program is sent again
  /// from the start; a macro is aborted, because it may be playing.
  Ended unanswered(ApiCommand command, const Answer& answer);

  /// Aborts a macro that has arrived in part, and returns the report.
  Report stopped(Report report);

  /// Waits until all answers of the ball have arrived. A duplicate answer, or a count that differs
  /// from the number of answers, means that a piece may be stored twice.
  Ended barrier(const Step& step);

  Ended doubled();

  Ended store(const Step& step);

  Ended save_user_macro(const Step& step);

  // After the content.

  Ended start(const Step& step);

  /// Returns true if something started without an answer shows that it runs.
  bool runs(const Step& step);

  Session& session_;
  const Plan& plan_;
  Progress& progress_;
  Status status_;
  Content content_ = Content::Unchanged;
  std::size_t uncounted_ = 0;   ///< pieces known only by their answers
  std::optional<Count> before_; ///< the count before the content
  /// In the ball's count.
  enum class Trust : std::uint8_t { NotYet, Yes, No } trust_ = Trust::NotYet;
};

} // namespace orb::uploader
