// A folder that was saved: which of the files that were chosen is its laboratory file, which its study.

const formats = { lab: /"format"\s*:\s*"pastefit-lab-/, study: /"format"\s*:\s*"pastefit-study-/ };

/**
 * Both texts, or which text of the page says why not.
 * @param {string[]} contents
 * @returns {{lab: string, study: string} | "filesMissing" | "filesTwice"}
 */
export function sheetOf(contents) {
  const labs = contents.filter((text) => formats.lab.test(text));
  const studies = contents.filter((text) => formats.study.test(text));
  if (labs.length === 0 || studies.length === 0) return "filesMissing";
  if (labs.length > 1 || studies.length > 1) return "filesTwice";
  return { lab: labs[0], study: studies[0] };
}
