/** What the lab says of itself, for tests and the curious. */
interface Window {
  lab?: {
    /** How many pictures have been drawn. */
    readonly drawn: number;
    readonly kinematics: {
      readonly target: readonly number[];
      readonly end: readonly number[];
      readonly status: string | null;
      readonly error_m: number | null;
      /** An answer is still to come. */
      readonly busy: boolean;
    };
  };
  /** Where the target is in the window, CSS pixels, while there is one. */
  labTarget?: () => { x: number; y: number } | null;
}
