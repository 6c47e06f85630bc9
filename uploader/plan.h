#pragma once

#include "protocol/macro.h"
#include "protocol/packet.h"
#include "uploader/budgets.h"

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

namespace orb::uploader {

/// The areas for programs, by their number in the commands. Source: API §Erase orbBasic Storage.
enum class Area : std::uint8_t { Ram = 0, Flash = 1 };

/// What an upload must know of the ball's firmware.
struct Firmware {
  std::size_t ram_bytes = 0; ///< of the orbBasic RAM area, the final NUL included
  std::size_t flash_bytes = 0;
  bool has_basic = false;
  bool can_commit = false; ///< Commit RAM Program to Flash exists (API 1.47)
};

/// Reads an answer of Get Versioning. A record of 8 bytes is from before API 1.46.
/// Source: API §Get Versioning and its history of revisions.
Firmware read_firmware(ByteView version_record);

/// The firmware that is assumed where no ball is asked: the newest.
Firmware default_firmware();

/// A program as it goes to the ball: text with its final NUL.
struct ProgramJob {
  Bytes image;
  Area area = Area::Ram;
  std::optional<std::uint16_t> start_line; ///< runs it from there
};

enum class MacroKind : std::uint8_t { Temporary, User, Stream };

struct MacroJob {
  protocol::MacroImage image;
  MacroKind kind = MacroKind::Temporary;
  bool run = false;          ///< a stream runs as it arrives in any case
  bool clear_others = false; ///< forget every user macro first
};

/// The way a thing is brought to the ball.
enum class Route : std::uint8_t {
  Ram,             ///< a program into RAM
  RamThenFlash,    ///< into RAM, then committed: flash changes at once or not at all
  FlashDirectly,   ///< erased and written in flash: a failure loses the old program
  TemporaryPacket, ///< a temporary macro in one packet
  TemporaryChunks, ///< a longer one in chunks
  UserMacro,       ///< a macro under its own id
  StreamedMacro    ///< a macro of any length, played while it arrives
};

/// What a step is to the upload that carries the plan out.
enum class StepKind : std::uint8_t {
  Greet,   ///< before anything changes: ping, versions, power
  Prepare, ///< harmless twice: abort, erase, clear
  Append,  ///< a piece of the whole; must arrive exactly once
  Barrier, ///< a ping behind the last piece
  Store,   ///< makes it last: commit, save
  Start    ///< runs it
};

struct Step {
  StepKind kind = StepKind::Greet;
  protocol::Command command; ///< with the sequence number that it has when all goes well
};

/// What will be sent, packet by packet, when nothing goes wrong, and the time by which an upload
/// has ended whatever goes wrong.
struct Plan {
  Route route = Route::Ram;
  std::vector<Step> steps;
  std::size_t size = 0;   ///< bytes of the program or macro
  std::size_t pieces = 0; ///< packets that carry them
  Duration deadline{};    ///< from the first attempt to open the link
  std::string note;       ///< what the user should know of the route; may be empty
};

/// Why something cannot be uploaded to this ball at all: a sentence.
struct PlanError {
  std::string message;
};

tl::expected<Plan, PlanError> make_plan(const ProgramJob& job, const Firmware& firmware,
                                        const Budgets& budgets, std::uint8_t first_seq);
tl::expected<Plan, PlanError> make_plan(const MacroJob& job, const Budgets& budgets,
                                        std::uint8_t first_seq);

Route choose_route(const ProgramJob& job, const Firmware& firmware);
Route choose_route(const MacroJob& job);
std::string_view to_string(Route route);

/// How much of `rest` goes into the next fragment: all that fits a packet, or a little less where
/// one bit error in DLEN would make a valid shorter packet of it. At least 1 of a `rest` that is
/// not empty.
std::size_t fragment_size(Area area, ByteView rest, std::uint8_t seq);
/// The data of an Append orbBasic Fragment.
Bytes fragment_data(Area area, ByteView piece);

/// The same for Append Macro Chunk; `rest` is the image from the second chunk on without header.
std::size_t chunk_size(ByteView rest, std::uint8_t seq);

/// The pieces of a streamed macro, each whole commands with id and flags in front, and Stream End
/// behind the last where the macro has none. An error where a comment is longer than a piece.
tl::expected<std::vector<Bytes>, PlanError> stream_pieces(const protocol::MacroImage& image);

/// The kind of macro that is meant where the user names none: a user macro where the image has a
/// user id, a stream where it has the stream's, else a temporary one, else, where it is too long for
/// that, a stream.
MacroKind natural_kind(const protocol::MacroImage& image);

} // namespace orb::uploader
