// The sounds of a run: rolling, bumps, and a cheer for a passed test. They are synthesised, and loaded when switched
// on.

const fastest = 200; // cm/s: as loud as it gets
const loudest = .12;
const fades_after = .2; // seconds after the last shown moment

/** True if the ball bumped into something between two moments. */
function bumped({ events }, from, to) {
  for (let i = events.length - 1; i >= 0 && events[i].t > from; --i) if (events[i].kind === "bump" && events[i].t <= to) return true;
  return false;
}

/** `playback` and `watch()` come from the player. */
export function make_sounds({ playback, watch }) {
  const audio = new AudioContext();
  let on = false;

  // Rolling is noise; it gets higher and louder with speed.
  const noise = audio.createBuffer(1, audio.sampleRate * 2, audio.sampleRate);
  const samples = noise.getChannelData(0);
  for (let i = 0; i < samples.length; ++i) samples[i] = Math.random() * 2 - 1;
  const rolling = audio.createBufferSource(), tone = audio.createBiquadFilter(), volume = audio.createGain();
  Object.assign(rolling, { buffer: noise, loop: true });
  Object.assign(tone, { type: "lowpass" });
  volume.gain.value = 0;
  rolling.connect(tone).connect(volume).connect(audio.destination);
  rolling.start();

  /** Plays a fading tone in `wait` seconds, gliding to the pitch `to`. */
  function ring(from, { to = from, wait = 0, lasts = .2, type = "sine", gain = .2 }) {
    const wave = audio.createOscillator(), fade = audio.createGain(), begin = audio.currentTime + wait;
    wave.type = type;
    wave.frequency.setValueAtTime(from, begin);
    wave.frequency.exponentialRampToValueAtTime(to, begin + lasts);
    fade.gain.setValueAtTime(gain, begin);
    fade.gain.exponentialRampToValueAtTime(.001, begin + lasts);
    wave.connect(fade).connect(audio.destination);
    wave.start(begin);
    wave.stop(begin + lasts);
  }

  let heard = 0; // bumps before this moment have been played
  watch(({ speed }) => {
    if (!on) return;
    const { now, playing } = playback, share = playing ? Math.min(speed / fastest, 1) : 0, { currentTime } = audio;
    volume.gain.cancelScheduledValues(currentTime);
    volume.gain.setTargetAtTime(share * loudest, currentTime, .05);
    volume.gain.setTargetAtTime(0, currentTime + fades_after, .05); // unless it goes on
    tone.frequency.setTargetAtTime(150 + 900 * share, currentTime, .05);
    if (playing && bumped(playback.main.run, heard, now)) ring(140, { to: 50, gain: .5 });
    heard = now;
  });

  const scale = [262, 294, 330, 392, 440, 523, 587, 659]; // pentatonic: the tones fit in any order
  return {
    /** Plays a few tones for a sound without a recording, always the same ones for a name. */
    call(name) {
      if (!on) return;
      let seed = 7;
      for (const char of name) seed = Math.imul(seed, 31) + char.charCodeAt(0) >>> 0;
      for (let i = 0; i < 4; ++i) ring(scale[seed >>> 3 * i & 7], { wait: i * .12, lasts: .18, type: "triangle" });
    },
    switch_on(wanted) {
      on = wanted;
      if (on) audio.resume();
      else audio.suspend();
    },
    cheer() {
      if (on) [523, 659, 784, 1047].forEach((pitch, i) => ring(pitch, { wait: i * .11, lasts: .35, type: "triangle" }));
    },
  };
}
