/** What a menu offers: something to be done, or a list of its own. */
export interface MenuItem {
  readonly says: string;
  /** What stands on the key that does it too. */
  readonly key?: string;
  readonly disabled?: boolean;
  /** Whether it is on; without it, it is nothing that is on or off. */
  readonly checked?: boolean;
  readonly run?: () => void;
  readonly items?: readonly MenuItem[];
}

/** An item, or a line between two groups of them. */
export type MenuEntry = MenuItem | "line";

/** A menu and where in the window it stands, pixels. */
export interface OpenMenu {
  readonly x: number;
  readonly y: number;
  /** What it is about. */
  readonly label: string;
  readonly entries: readonly MenuEntry[];
}
