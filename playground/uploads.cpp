#include "playground/uploads.h"

#include "run/delivery.h"
#include "spec/ble.h"
#include "spec/serial.h"
#include "uploader/ble.h"

#include <utility>

namespace orb::playground {
namespace {

using protocol::LinkError;

/// The link as far as it has been used; then it wishes.
class Log final : public protocol::Transport {
public:
  explicit Log(const std::vector<Done>& done) : done_(done) {}

  Instant now() const override { return now_; }

  tl::expected<void, LinkError> write(ByteView bytes) override {
    const auto* done = next({{"write", bytes_json(bytes)}});
    return failed(done) ? tl::unexpected(error(done)) : tl::expected<void, LinkError>();
  }

  tl::expected<Bytes, LinkError> read(Instant deadline) override {
    const auto* done = next({{"read_until", milliseconds(deadline.time_since_epoch())}});
    return failed(done) ? tl::unexpected(error(done)) : tl::expected<Bytes, LinkError>(done->bytes);
  }

  /// What is to be done next; null where the log was enough.
  const ordered_json& wish() const { return wish_; }

private:
  const Done* next(ordered_json wish) {
    if (at_ == done_.size()) {
      if (wish_.is_null())
        wish_ = std::move(wish);
      return nullptr;
    }
    now_ = done_[at_].at;
    return &done_[at_++];
  }
  static bool failed(const Done* done) { return done == nullptr || done->error; }
  static LinkError error(const Done* done) {
    return done == nullptr ? LinkError{LinkError::Kind::Ended, "not yet"} : *done->error;
  }

  const std::vector<Done>& done_;
  std::size_t at_ = 0;
  Instant now_{};
  ordered_json wish_;
};

/// Remembers what was told last.
class Last final : public uploader::Progress {
public:
  void on_item(std::string_view name) override { item_ = name; }
  void on_status(const uploader::Status& status, Instant) override { status_ = status; }

  ordered_json json() const {
    return {{"item", item_},
            {"stage", uploader::to_string(status_.stage)},
            {"bytes", status_.bytes_sent},
            {"bytes_total", status_.bytes_total},
            {"packets", status_.packets},
            {"packets_total", status_.packets_total},
            {"attempt", status_.attempt}};
  }

private:
  std::string item_;
  uploader::Status status_;
};

std::string_view word(uploader::Report::Kind kind) {
  switch (kind) {
  case uploader::Report::Kind::Done: return "done";
  case uploader::Report::Kind::Impossible: return "impossible";
  case uploader::Report::Kind::Refused: return "refused";
  case uploader::Report::Kind::NoBall: return "no-ball";
  case uploader::Report::Kind::LinkLost: return "link-lost";
  case uploader::Report::Kind::Unknown: return "unknown";
  case uploader::Report::Kind::Interrupted: return "interrupted";
  }
  return "";
}

ordered_json place_json(spec::BleCharacteristic characteristic) {
  const auto& row = spec::info(characteristic);
  return {{"service", spec::ble_services[static_cast<std::size_t>(row.service)].uuid},
          {"characteristic", row.uuid}};
}

/// How a robot is found and opened to commands.
ordered_json ble_json(const uploader::Budgets& budgets) {
  auto services = ordered_json::array();
  for (const auto& row : spec::ble_services)
    if (row.protocol == spec::BleProtocol::V1)
      services.push_back(row.uuid);
  auto names = ordered_json::array();
  for (const auto& row : spec::ble_names)
    if (row.protocol == spec::BleProtocol::V1)
      names.push_back(row.prefix);
  auto greeting = ordered_json::array();
  for (const auto& row : spec::ble_greeting) {
    if (spec::protocol_of(row.characteristic) != spec::BleProtocol::V1)
      continue;
    greeting.push_back(place_json(row.characteristic));
    greeting.back()["bytes"] = bytes_json(as_bytes(row.bytes));
  }
  return {{"services", services},
          {"names", names},
          {"greeting", greeting},
          {"commands", place_json(spec::BleCharacteristic::Commands)},
          {"answers", place_json(spec::BleCharacteristic::Answers)},
          {"piece", spec::ble_piece_bytes},
          {"connect_ms", milliseconds(budgets.ble_connect)},
          {"write_ms", milliseconds(budgets.ble_send)}};
}

LinkError read_error(const ordered_json& error) {
  const auto kind = error.value("kind", "broken");
  return {kind == "closed"        ? LinkError::Kind::Closed
          : kind == "interrupted" ? LinkError::Kind::Interrupted
                                  : LinkError::Kind::Broken,
          error.value("message", "")};
}

} // namespace

Answer links(Request&) {
  const uploader::Budgets budgets;
  auto pauses = ordered_json::array(); // between the tries
  for (int n = 1; n < budgets.opens; ++n)
    pauses.push_back(milliseconds(budgets.backoff(n)));
  return print(
      {{"pauses_ms", pauses},
       {"serial",
        {{"baud_rate", spec::serial_baud_rate}, {"write_ms", milliseconds(budgets.write)}}},
       {"ble", ble_json(budgets)}});
}

tl::expected<Upload, Problem> Upload::start(Request& request) {
  const auto inputs = request.inputs();
  if (!inputs)
    return tl::unexpected(inputs.error());
  run::DeliveryOptions options;
  options.area = request.text("area", "ram") == "flash" ? spec::Area::Flash : spec::Area::Ram;
  options.run = request.flag("run");
  options.line = request.value<std::uint16_t>("line");
  options.clear_macros = request.flag("clear_macros");
  auto delivery = run::arrange(*inputs, options);
  if (!delivery)
    return refuse(delivery.error());
  Upload upload;
  upload.delivery_ = *std::move(delivery);
  upload.battery_ =
      request.flag("force") ? uploader::BatteryPolicy::Ignore : uploader::BatteryPolicy::Refuse;
  if (request.text("link") == "ble")
    upload.budgets_ = uploader::ble_budgets(upload.budgets_);
  upload.first_seq_ = request.value<std::uint8_t>("first_seq").value_or(0);
  return upload;
}

std::string Upload::step(const ordered_json& done) {
  if (done.contains("at")) {
    Done one{Instant{} + duration_of(done.at("at").get<double>()), {}, {}};
    if (const auto bytes = done.find("bytes"); bytes != done.end())
      one.bytes = bytes_of(*bytes);
    if (const auto error = done.find("error"); error != done.end())
      one.error = read_error(*error);
    log_.push_back(std::move(one));
  }
  return next();
}

std::string Upload::next() {
  Log link(log_);
  Last progress;
  uploader::Session session(link, budgets_, first_seq_);
  const auto report = uploader::deliver(session, delivery_, battery_, progress);
  if (!link.wish().is_null())
    return print({{"wish", link.wish()}, {"status", progress.json()}});
  return print({{"outcome",
                 {{"kind", word(report.kind)},
                  {"code", static_cast<int>(uploader::exit_code(report.kind))},
                  {"message", report.message},
                  {"packets", session.counts().packets_out},
                  {"ms", milliseconds(link.now().time_since_epoch())}}}});
}

} // namespace orb::playground
