// Which language the page is in: as the address says (`?lang=de`), as was chosen here before, or as the browser asks for.
// It stands in the page's head, so that its first sentence is right already.
{
  const languages = ["en", "de", "ja"];
  /** @type {unknown} */
  let kept;
  try {
    /** @type {unknown} */
    const stored = JSON.parse(localStorage.getItem("reina") ?? "{}");
    if (stored instanceof Object && "language" in stored) kept = stored.language;
  } catch {
    kept = undefined;
  }
  const asked = [new URLSearchParams(location.search).get("lang"), kept, ...navigator.languages];
  const codes = asked.map((tag) => String(tag).toLowerCase().split("-")[0]);
  document.documentElement.lang = codes.find((code) => languages.includes(code)) ?? "en";
}
