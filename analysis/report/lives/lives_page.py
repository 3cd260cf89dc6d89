"""Page of gearpod lives: cracks that grow in monitored gearboxes."""

import blocks
from lives import lives_figures
from lives.campaign_data import CampaignData
from words import count, escape, number, percent


def _summaries(campaign):
    rows = []
    for one in campaign.data["monitored"]:
        alarms = one["false_alarms"]
        low, high = alarms["bounds"]
        share = "–" if one["share"] is None else (
            f"{one['found']}/{one['ended']}\u00a0[{one['share_bounds'][0]:.2f},\u00a0"
            f"{one['share_bounds'][1]:.2f}]")
        rows.append([one["feature"], one["detector"], _number(one["threshold"]),
                     f"{_number(alarms['per_1000_h'])}\u00a0[{_number(low)},\u00a0{_number(high)}]", share,
                     "–" if one["share_by_chance"] is None else f"{one['share_by_chance']:.2f}",
                     *(["–", "–"] if one["share"] is None else
                       [campaign.depth_text(one["depth_50_m"]),
                        campaign.depth_text(one["depth_90_m"])]),
                     _number(one["warning_50_h"]), _number(one["warning_90_h"])])
    return blocks.table("Every feature with every detector; by chance: the share that false "
                        "alarms alone would find in lives of the same length",
                        ["feature", "detector", "threshold", "false alarms per 1000 h",
                         "found before the end", "by chance", "50 % found by, mm",
                         "90 % found by, mm", "median warning, h", "90 % at least, h"], rows)


def _number(value):
    return "–" if value is None else number(value)


def _about(campaign):
    data = campaign.data
    texts = [f"{count(len(data['lives']))} gearboxes crack, growing from "
             f"{number(1e3 * data['first_depth_m'])} to {number(campaign.last_mm)} mm; one record "
             f"every {number(data['interval_h'])} hours, the first "
             f"{count(data['baseline_records'])} of them are the gearbox's baseline.",
             f"{count(data['healthy_lives']['setting'])} healthy lives set the thresholds, "
             f"{count(data['healthy_lives']['counting'])} others are used to count false alarms."]
    texts.append(f"A record: {data['record']}.")
    if data["failed"]:
        texts.append(f"{count(data['failed'])} gearboxes failed and are left out.")
    off = data["interpolation"]
    if off["first"] is not None:
        texts.append(
            "Records are superposed from simulated signals. The interpolation error (rms) is "
            f"{percent(off['first'])} of the change by the crack at "
            f"{number(1e3 * off['first_depth_m'])} mm and {percent(off['last'])} of it at "
            f"{number(1e3 * off['last_depth_m'])} mm; between the simulated torques and speeds it "
            f"is {number(100 * off['load'])}\u00a0% of the signal.")
    costs = data["costs"]
    if costs["gearboxes"] and costs["records"]:
        texts.append(
            f"Processor time: {number(costs['gearbox_s'] / costs['gearboxes'])} s per gearbox, "
            f"{number(1e3 * costs['record_s'] / costs['records'])} ms per record "
            f"({count(costs['gearboxes'])} gearboxes, {count(costs['records'])} records).")
    return blocks.bullets(texts)


def parts(data, page):
    """Title, headline sentence, HTML of the answer, HTML of the sections."""
    campaign = CampaignData(data)
    sentence = campaign.sentence()
    body = page.section("fan", "Lives", lives_figures.fan(campaign, page))
    body += page.section("warning", "Warning times", lives_figures.warning_times(campaign, page))
    body += page.section("trade-off", "False alarms and depth",
                         lives_figures.trade_off(campaign, page))
    body += page.section("all", "Features and detectors", _summaries(campaign))
    body += page.section("about", "Basis of the results", _about(campaign))
    summary = "\n".join(f'<p class="answer">{escape(text)}</p>'
                       for text in (sentence, data["assumptions"]) if text)
    return data["title"], sentence, summary, body
