"""Page of gearpod lives: cracks that grow in monitored gearboxes."""

import blocks
from lives import lives_figures
from lives.campaign_data import CampaignData


def parts(data, page):
    """Title, headline sentence, HTML of the answer, HTML of the sections."""
    campaign = CampaignData(data)
    body = ""
    if not data["withheld"]:
        body += page.section("fan", "Lives", lives_figures.fan(campaign, page))
        body += page.section("warning", "Warning times", lives_figures.warning_times(campaign, page))
        body += page.section("trade-off", "False alarms and depth",
                             lives_figures.trade_off(campaign, page))
        body += page.section("all", "Features and detectors",
                             campaign.table("results") + blocks.bullets(
                                 campaign.texts("terms") + campaign.texts("unranked.")))
    body += page.section("about", "Basis of the results", blocks.bullets(campaign.texts("basis.")))
    summary = "\n".join(blocks.answer(text) for key in ("headline", "interpolation", "failed", "holds")
                        if (text := campaign.text(key)))
    return data["title"], campaign.text("headline"), summary, body
