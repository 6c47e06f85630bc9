// Uploads a program over a link of your own. This one counts the bytes and hands them to a ball in
// this process; yours may be a radio, a test double or a cable.
#include <orb/compiler/check.h>
#include <orb/compiler/load.h>
#include <orb/compiler/text/image.h>
#include <orb/uploader/upload.h>
#include <orb/vm/ball_transport.h>

#include <cstdio>

namespace {

class Counted final : public orb::protocol::Transport {
public:
  explicit Counted(orb::protocol::Transport& link) : link_(link) {}

  orb::Instant now() const override { return link_.now(); }
  tl::expected<void, orb::protocol::LinkError> write(orb::ByteView bytes) override {
    sent += bytes.size();
    return link_.write(bytes);
  }
  tl::expected<orb::Bytes, orb::protocol::LinkError> read(orb::Instant deadline) override {
    return link_.read(deadline);
  }

  std::size_t sent = 0;

private:
  orb::protocol::Transport& link_;
};

} // namespace

int main() {
  orb::vm::BallOptions options;
  options.loader = orb::compiler::load;
  orb::vm::Ball ball(options);
  orb::vm::BallTransport wire(ball);
  Counted link(wire);

  const auto checked = orb::compiler::check("10 RGB 0,255,0\n", {});
  orb::uploader::Delivery delivery;
  const auto image = build_image(checked.program, orb::compiler::Packing::Packed);
  delivery.program_name = "green.bas";
  delivery.program.emplace();
  delivery.program->image.assign(image.bytes.begin(), image.bytes.end());

  orb::uploader::Session session(link, {}, 1);
  orb::uploader::NullProgress nobody;
  const auto report = deliver(session, delivery, orb::uploader::BatteryPolicy::Refuse, nobody);
  std::printf("%s (%zu bytes sent)\n", report.message.c_str(), link.sent);
  return report.kind == orb::uploader::Report::Kind::Done ? 0 : 1;
}
