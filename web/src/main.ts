import "./styles/page.css";
import { mount } from "svelte";
import App from "./App.svelte";
import { beginLanguage } from "./words";

const target = document.getElementById("page");
if (target === null) throw new TypeError("index.html has no element #page to mount the page in");
await beginLanguage();
mount(App, { target });
