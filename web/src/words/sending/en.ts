import { counted, filled, words } from "../words";

/** What is said of files on their way to the server, of a server that is busy or away, and of what did not get there. */
export const sending = words("sending", {
  title: filled("Sending {name}"),
  share: filled("{share} of {size}"),
  begins: "It begins to leave …",
  reads: "All of it is there. The server is reading it …",
  cancel: "Cancel",
  cancelFile: filled("Cancel sending {name}"),
  notSent: filled("{name} did not get there"),
  stillHere: "The files are still chosen: send them again once the server can take them.",
  sendAgain: "Send again",
  leaveIt: "Leave it",
  again: counted({
    one: "Trying again in {count} second.",
    other: "Trying again in {count} seconds.",
  }),
  asksNow: "Trying again now …",
  tryNow: "Try now",
  notChanged: counted({ one: "This was not changed", other: "{count} changes were not made" }),
  asBefore: "Everything stays as it was.",
});
