import assert from "node:assert/strict";
import { test } from "node:test";
import { typeInCsv, typeInTabs } from "../../../calibrate/report/page/source/type_in.js";

const groups = [
  {
    title: "Grain on grain: Hertz, EPSD",
    rows: [
      { quantity: "sliding friction", value: "0.3", unit: "", remark: 'of the "elastic" normal force' },
      { quantity: "d_c", value: "-1.2", unit: "mm", remark: "" },
    ],
  },
];

test("the numbers to type in are CSV with a head, and a group in each row", () => {
  assert.deepEqual(typeInCsv(groups).split("\r\n"), [
    "group,quantity,value,unit,remark",
    '"Grain on grain: Hertz, EPSD",sliding friction,0.3,,"of the ""elastic"" normal force"',
    '"Grain on grain: Hertz, EPSD",d_c,-1.2,mm,',
    "",
  ]);
});

test("copied numbers have tabs between their cells, so that a spreadsheet takes them apart", () => {
  assert.equal(typeInTabs(groups).split("\n")[2], "Grain on grain: Hertz, EPSD\td_c\t-1.2\tmm\t");
});
