/** What an AudioContext says about its clock at one moment; times in seconds. */
export interface AudioClockReading {
  /** The page's clock when this was read. */
  readonly pageTime: number;
  /** AudioContext.currentTime: what is being computed, not yet heard. */
  readonly currentTime: number;
  readonly outputLatency: number | undefined;
  readonly baseLatency: number | undefined;
  /** AudioContext.getOutputTimestamp(): which context time leaves the loudspeaker at which time of the page. */
  readonly outputContextTime: number | undefined;
  readonly outputPageTime: number | undefined;
}

/** A latency over this is a driver's nonsense, not a loudspeaker. */
const LONGEST_LATENCY_S = 0.5;

/**
 * The context time that is heard at the moment of the reading, seconds.
 *
 * The output timestamp is smooth where currentTime goes in steps, so it is taken whenever it is believable: the latency
 * that follows from it must lie between nothing and half a second. Otherwise the reported latencies are, under the
 * same condition.
 */
export function heardContextTime(reading: AudioClockReading): number {
  const { outputContextTime, outputPageTime, pageTime, currentTime } = reading;
  if (outputContextTime !== undefined && outputPageTime !== undefined && outputContextTime > 0 && outputPageTime > 0) {
    const heard = outputContextTime + (pageTime - outputPageTime);
    const latency = currentTime - heard;
    // currentTime goes in steps of a render quantum or a device buffer, so that heard may seem a little ahead of it.
    if (latency > -0.03 && latency < LONGEST_LATENCY_S) return heard;
  }
  return currentTime - (believable(reading.outputLatency) ?? believable(reading.baseLatency) ?? 0);
}

function believable(latency: number | undefined): number | undefined {
  return latency !== undefined && latency > 0 && latency < LONGEST_LATENCY_S ? latency : undefined;
}
