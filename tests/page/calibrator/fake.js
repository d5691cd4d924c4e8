// A module with the interface of calibrate/browser for tests of the page: it "simulates" by waiting, and confirms after
// so many answers. It is given to the build in place of the real one, with a module of WebAssembly that is empty.
// A title begins with what is to go wrong: "killer" ends each worker at its third simulation, "refused" refuses the
// study. With "slow" or "killer" it lingers once, so that the page can be looked at and stopped on any machine.
// @ts-nocheck: what is asked is known to the page's own types

const budget = 12;
const lingering = [8, 9]; // simulations that the page shows as under way for some seconds: one of each of two workers
const preset = (name, title, [base, top, height], more = {}) => ({
  name,
  title,
  sheet: true,
  drops: 0,
  caution: "",
  apparatus: { mould: { base_diameter_mm: base, top_diameter_mm: top, height_mm: height } },
  ...more,
});

const text = (content) => `// made by a test\n${JSON.stringify(content, null, 2)}\n`;
const read = (content) => JSON.parse(content.replace(/^\/\/.*$/gm, ""));
const fault = (where, what, remedy) => ({ where, what, remedy });

const points = [
  [-150, 0],
  [-80, 90],
  [0, 120],
  [80, 90],
  [150, 0],
];

let search = null;
let simulated = 0; // by this worker

function faultsOf({ mould, density, slump, confirm }) {
  const faults = [];
  if (!mould) faults.push(fault("--mould", "is missing", "e.g. abrams"));
  if (!/^[\d.]+( \S+)?$/.test(density)) faults.push(fault("density", `holds "${density}"`, "e.g. 2350"));
  if (Number.parseFloat(density) < 100 && !confirm.includes("material.bulk_density_kg_m3"))
    faults.push(
      fault(
        "material.bulk_density_kg_m3",
        "is small",
        'if it is right, say "confirmed": ["material.bulk_density_kg_m3"]',
      ),
    );
  if (slump && /[a-z]$/.test(slump) && !/(mm|cm|in)$/.test(slump))
    faults.push(fault("reading slump", `holds "${slump}", which is not a number`, 'e.g. "180, 175, 190"'));
  if (!slump) faults.push(fault("--slump", "is missing, and every other reading", "e.g. --slump 180"));
  return faults;
}

const calls = {
  version: () => ({ ok: { version: "test", engine: "0", kernels: "none" } }),
  presets: () => ({
    ok: [
      preset("abrams", "Abrams cone", [200, 100, 300]),
      preset("hinged-plate", "Cone on a hinged plate", [200, 130, 200], { drops: 1 }),
      { name: "shear-box", title: "no mould", sheet: false, drops: 0, caution: "", apparatus: {} },
      preset("astm-c1437", "Flow mould on its table", [100, 70, 50], { drops: 25 }),
    ],
  }),
  new: (request) => {
    const faults = faultsOf(request);
    if (faults.length > 0) return { faults };
    const { title = "my paste", ...asked } = request;
    const lab = text({ format: "pastefit-lab-1", title, asked });
    return { ok: { lab, study: text({ format: "pastefit-study-1", title }), notes: ["a note on the sheet"] } };
  },
  open: ({ lab, study, seed = 1, stored }) => {
    const { title } = read(study);
    if (title.startsWith("refused")) return { faults: [fault("lab.json: title", "is refused", "another title")] };
    search = { title, seed, lab: read(lab), answers: [...stored], asked: 0, next: 0, stopped: false, fresh: [] };
    return { ok: { title, budget } };
  },
  suggest: ({ count }) => {
    const left = budget - search.answers.length - search.asked;
    const tasks = Array.from({ length: Math.min(count, left) }, (_, k) => ({
      id: search.next + k,
      task: JSON.stringify({ title: search.title, number: search.answers.length + search.asked + k }),
    }));
    search.asked += tasks.length;
    search.next += tasks.length;
    return { ok: tasks };
  },
  ingest: (answers) => {
    search.asked -= answers.length;
    search.answers.push(...answers);
    return { ok: { finished: search.answers.length >= budget, records: answers } };
  },
  progress: () => ({
    ok: {
      phase: search.answers.length < 8 ? "search" : "confirmation",
      simulations: search.answers.length,
      budget,
      best_error: search.answers.length > 0 ? 0.5 : null,
      readings: [{ name: "step1.slump_mm", measured: 181.7, simulated: 180, tolerance: 7.5 }],
      why: "the best candidate is not confirmed yet",
      sheared: [1, 3],
    },
  }),
  stop: () => {
    search.stopped = true;
    return { ok: {} };
  },
  result: () => {
    const status = search.stopped ? "stopped" : "confirmed";
    const card = { format: "pastefit-card-6", title: search.title, search: { status, seed: search.seed } };
    const shown = search.title.replace(/[&<>]/g, (letter) => `&#${letter.charCodeAt(0)};`);
    const script = '<script>document.body.append("drawn")</script>';
    const report = `<!doctype html><title>report</title><h1>${shown}</h1>${script}`;
    return {
      ok: {
        status,
        reason: "as it was asked",
        card: JSON.stringify(card),
        summary: `${search.title}\n${status}\n`,
        report,
      },
    };
  },
  export: ({ target }) =>
    target === "yade"
      ? { faults: [fault("--to yade", "has no such law", "another target")] }
      : {
          ok: {
            files: [
              { name: `in.${target}`, text: `# ${target}\n` },
              { name: "README.txt", text: "read\n" },
            ],
          },
        },
  simulate: ({ task }) => {
    const { title, number } = JSON.parse(task);
    simulated += 1;
    if (title.startsWith("killer") && simulated === 3) throw new Error("out of memory");
    const end = performance.now() + (/^(slow|killer)/.test(title) && lingering.includes(number) ? 6000 : 60);
    while (performance.now() < end);
    return {
      ok: {
        answer: `${number}`,
        outline: { heap: true, points },
      },
    };
  },
};

/** Places in a memory that there is not: the texts themselves. */
const texts = new Map();
let places = 0;
const stringToNewUTF8 = (content) => {
  places += 1;
  texts.set(places, content);
  return places;
};

self.pastefit = async ({ instantiateWasm }) => {
  await new Promise((resolve) => instantiateWasm({}, resolve));
  return {
    stringToNewUTF8,
    UTF8ToString: (place) => texts.get(place),
    _free: (place) => texts.delete(place),
    _pastefit_call: (name, request) =>
      stringToNewUTF8(JSON.stringify(calls[texts.get(name)](JSON.parse(texts.get(request))))),
  };
};
