import "../styles/page.css";
import { mount } from "svelte";
import Lab from "./Lab.svelte";
import { beginLanguage } from "../words";

const target = document.getElementById("page");
if (target === null) throw new TypeError("lab.html has no element #page to mount the lab in");
await beginLanguage("lab");
mount(Lab, { target });
