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

/// What the ball refused and why, with what is on it now (`state`) and the remedy.
Report refused(ApiCommand command, const Response& response, Content content,
               std::string_view state);

/// No answer, or none but "damaged"; Kind::Interrupted where the user stopped it.
Report lost(const Session& session, ApiCommand command, const NoAnswer& failure, Content content,
            std::string_view state);

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

  std::string state() const;

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
