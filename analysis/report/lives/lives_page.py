"""Page of gearpod lives: cracks that grow in monitored gearboxes."""

import blocks
from lives import lives_figures
from lives.campaign_data import CampaignData
from words import count, escape, number, percent


def _answers(campaign):
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
    return blocks.table("Every feature by every detector; by chance: the share that false alarms "
                        "alone would find in lives as long",
                        ["feature", "detector", "threshold", "false alarms in 1000 h",
                         "found before the end", "by chance", "50 % by, mm", "90 % by, mm", "warning, h",
                         "nine in ten, h"], rows)


def _number(value):
    return "–" if value is None else number(value)


def _about(campaign):
    data = campaign.data
    texts = [f"{count(len(data['lives']))} gearboxes crack, from {number(1e3 * data['first_depth_m'])} "
             f"to {number(campaign.last_mm)} mm; a record each {number(data['interval_h'])} hours, "
             f"the first {count(data['baseline_records'])} of them the gearbox's own baseline.",
             f"{count(data['healthy_lives']['setting'])} healthy lives set the thresholds, "
             f"{count(data['healthy_lives']['counting'])} others count false alarms."]
    texts.append(f"A record: {data['record']}.")
    if data["failed"]:
        texts.append(f"{count(data['failed'])} gearboxes failed and are left out.")
    off = data["interpolation"]
    if off["first"] is not None:
        texts.append(
            "Records are composed of marched signals. Interpolated ones are off (rms) by "
            f"{percent(off['first'])} of what the crack changes at {number(1e3 * off['first_depth_m'])} "
            f"mm and {percent(off['last'])} of it at {number(1e3 * off['last_depth_m'])} mm; between "
            f"the torques and speeds that are marched by {number(100 * off['load'])}\u00a0% of the signal.")
    costs = data["costs"]
    if costs["gearboxes"] and costs["records"]:
        texts.append(
            f"Processor time: {number(costs['gearbox_s'] / costs['gearboxes'])} s a gearbox, "
            f"{number(1e3 * costs['record_s'] / costs['records'])} ms a record "
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
    body += page.section("all", "Features and detectors", _answers(campaign))
    body += page.section("about", "What this stands on", _about(campaign))
    answer = "\n".join(f'<p class="answer">{escape(text)}</p>'
                       for text in (sentence, data["assumptions"]) if text)
    return data["title"], sentence, answer, body
