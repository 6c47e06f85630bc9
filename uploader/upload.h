#pragma once

#include "base/exit_code.h"
#include "uploader/plan.h"
#include "uploader/session.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::uploader {

/// What is in the place that an upload was for.
enum class Content : std::uint8_t {
  Unchanged,
  ErasedOrUnchanged, ///< the erase was sent, its answer is missing
  Erased,
  Incomplete,  ///< a front part of the program or macro, perhaps all of it
  Uncommitted, ///< RAM holds the program, flash is unchanged
  Unconfirmed, ///< all of it was sent; whether it is there is not known
  Stored
};

/// How an upload ended. Only Done is success.
struct Report {
  enum class Kind : std::uint8_t {
    Done,
    Impossible, ///< it cannot fit this ball; nothing was changed
    Refused,    ///< the ball said no, or its battery is too low
    NoBall,     ///< nothing that answers like a ball
    LinkLost,   ///< the link failed or the ball fell silent; `content` is what is known
    Unknown,    ///< it may have worked: neither success nor failure
    Interrupted ///< by the user
  };
  Kind kind = Kind::Done;
  Content content = Content::Unchanged;
  std::string message;   ///< one sentence: what happened, what is on the ball, what helps
  std::uint8_t code = 0; ///< of Refused, where the ball said it
  /// Pieces that the ball has answered without telling how many it received: see unseen_bound().
  std::size_t uncounted = 0;
};

/// The greatest share of uploads that look right and are not, over a link that delivers a share
/// `doubled` of commands twice and loses a share `lost` of packets in each direction, to a ball
/// that does not tell how many packets it has received: one of `pieces` came twice, and one of its
/// answers was lost. A link that doubles nothing gives 0.
double unseen_bound(std::size_t pieces, double doubled, double lost);

/// The code that a command ends with after such a report.
ExitCode exit_code(Report::Kind kind);

/// What a ball said of itself before anything was changed.
struct Greeting {
  Bytes versions;
  Capabilities firmware;
  std::optional<Bytes> power; ///< the answer of Get Power State, where the ball gives one

  /// The power state of the API, 0 where it is not known.
  std::uint8_t power_state() const;
};

enum class Stage : std::uint8_t {
  Greeting,
  Preparing,
  Sending,
  Confirming,
  Storing,
  Starting,
  Done
};
std::string_view to_string(Stage stage);

/// Where an upload stands.
struct Status {
  Stage stage = Stage::Greeting;
  std::size_t bytes_sent = 0; ///< of the program or macro, answered for
  std::size_t bytes_total = 0;
  std::size_t packets = 0;       ///< that were answered for and carry them
  std::size_t packets_total = 0; ///< planned; resends and short fragments add to it
  int attempt = 1;
  Duration expected{}; ///< about how long all of it takes, where that is known beforehand
};

/// Is told how an upload goes on.
class Progress {
public:
  virtual ~Progress() = default;
  /// The next of several things begins.
  virtual void on_item(std::string_view name) = 0;
  virtual void on_status(const Status& status, Instant now) = 0;
};

/// For uploads that nobody watches.
class NullProgress final : public Progress {
public:
  void on_item(std::string_view) override {}
  void on_status(const Status&, Instant) override {}
};

/// Whether a nearly empty battery stops what writes to flash.
enum class BatteryPolicy : std::uint8_t { Refuse, Ignore };

/// `firmware 0.98, orbBasic 0.9, macro executive 2`
std::string describe_firmware(const Greeting& greeting);

/// Waits for stray bytes, pings until there is an answer, asks for versions and power.
tl::expected<Greeting, Report> greet(Session& session);

/// What helps a ball that is in its bootloader: one that was sent there, or whose update was cut
/// short (REC; what help the vendor's support gives for a ball that flashes red).
std::string bootloader_remedy(std::string_view port = "…");

/// Why a ball that was greeted takes neither programs nor macros: it is in its bootloader.
std::optional<Report> refuse_bootloader(const Greeting& greeting, std::string_view port = "…");

/// Puts a program into the ball and says the truth about it (docs/uploading.md). Ends before the
/// deadline of the plan.
Report upload(Session& session, const ProgramJob& job, const Greeting& greeting,
              BatteryPolicy battery, Progress& progress);

/// The same for a macro.
Report upload(Session& session, const MacroJob& job, Progress& progress);

/// What goes to a ball in one go: macros first, then the program.
struct Delivery {
  struct NamedMacro {
    std::string name; ///< for messages
    MacroJob job;
  };
  std::vector<NamedMacro> macros;
  std::string program_name;
  std::optional<ProgramJob> program;
  std::string port = "…"; ///< as the user names it, for messages
  /// Why a ball that has told what it is should not get it: a sentence. Nothing is changed then.
  std::function<std::optional<std::string>(const Greeting&)> misfit = {};
};

/// Greets the ball and uploads all of it, up to the first that is not Done. What can be seen
/// beforehand to go wrong is refused before anything is sent. Where there are several, the message
/// says which one it speaks of.
Report deliver(Session& session, const Delivery& delivery, BatteryPolicy battery,
               Progress& progress);

/// Waits for what a program says that was started: an error, or a print and whatever comes just
/// behind it; at most Budgets::start_sign. The messages stay in the inbox.
tl::expected<void, NoAnswer> await_start(Session& session);

/// Stops the wheels, whatever drove them. A program that stops with an error leaves them turning.
tl::expected<void, NoAnswer> brake(Session& session);

/// Stops what runs and commits the program in RAM to flash.
Report commit(Session& session, const Greeting& greeting, BatteryPolicy battery);

/// What is known of the ball when a command has failed, for the end of a message.
struct Known {
  std::string if_lost; ///< or interrupted; empty for what is known of any such command
  std::string if_refused{};
};

/// Sends one command and says how it went: until it is answered where that does no harm, else once.
tl::expected<protocol::Response, Report> request(Session& session, spec::ApiCommand command,
                                                 const Bytes& data = {}, const Known& known = {});

} // namespace orb::uploader
