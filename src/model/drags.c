/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Assembly of the drags of speed alone: what each part of the description adds.
 */
#include "model/gearset.h"

#include "base/alloc.h"

#include <math.h>

#define INFINITE_CLEARANCE 0.0 /* a synchroniser without a clearance has no open drag */

static void add_seals_and_gaps(gm_gearset *gearset)
{
    const gm_description *d = gearset->description;
    for (int i = 0; i < d->n_seals; i++)
        gearset->drags[gearset->n_drags++] =
            (gm_drag_element){.kind = GM_LOSS_SEAL,
                              .name = d->seals[i].id.name,
                              .body = d->seals[i].shaft,
                              .on = d->seals[i].on,
                              .position = (double)NAN,
                              .law = GM_DRAG_SEAL,
                              .seal = d->seals[i].model,
                              .radius = 0.5 * d->seals[i].diameter};
    for (int i = 0; i < d->n_gaps; i++)
        gearset->drags[gearset->n_drags++] =
            (gm_drag_element){.kind = GM_LOSS_GAP,
                              .name = d->gaps[i].id.name,
                              .body = d->gaps[i].inner,
                              .on = d->gaps[i].outer,
                              .position = (double)NAN,
                              .law = GM_DRAG_GAP,
                              .radius = d->gaps[i].radius,
                              .length = d->gaps[i].length,
                              .clearance = d->gaps[i].clearance};
}

static void add_cones(gm_gearset *gearset)
{
    const gm_description *d = gearset->description;
    for (int i = 0; i < d->n_synchronisers; i++) {
        const gm_synchroniser *sync = &d->synchronisers[i];
        for (int k = 0; k < sync->n_wheels && sync->cone_clearance > INFINITE_CLEARANCE;
             k++)
            gearset->drags[gearset->n_drags++] =
                (gm_drag_element){.kind = GM_LOSS_SYNCHRONISER,
                                  .name = d->wheels[sync->wheels[k]].id.name,
                                  .body = gearset->wheel_body[sync->wheels[k]],
                                  .on = sync->shaft,
                                  .position = d->wheels[sync->wheels[k]].position,
                                  .law = GM_DRAG_GAP,
                                  .radius = sync->cone_radius,
                                  .length = sync->cone_width,
                                  .clearance = sync->cone_clearance};
    }
}

static gm_plates gap_of(const gm_clutch *clutch)
{
    return (gm_plates){.n = clutch->surfaces,
                       .r_i = clutch->inner_radius,
                       .r_o = clutch->outer_radius,
                       .h = clutch->clearance,
                       .feed = isnan(clutch->feed) ? (double)INFINITY : clutch->feed};
}

/* A closed clutch has no relative speed and so no drag. */
static void add_clutches(gm_gearset *gearset)
{
    const gm_description *d = gearset->description;
    for (int i = 0; i < d->n_clutches; i++)
        if (d->clutches[i].surfaces > 0)
            gearset->drags[gearset->n_drags++] =
                (gm_drag_element){.kind = GM_LOSS_CLUTCH,
                                  .name = d->clutches[i].id.name,
                                  .body = d->clutches[i].shaft,
                                  .on = d->clutches[i].on,
                                  .position = (double)NAN,
                                  .law = GM_DRAG_CLUTCH,
                                  .plates = gap_of(&d->clutches[i])};
}

static double pitch_radius(const gm_wheel *wheel)
{
    return 0.5 * wheel->normal_module * wheel->teeth / cos(wheel->helix);
}

/* Oil above the lowest point of a wheel's tip circle, 0 when it is dry. Planets go round:
 * their dip is not looked at. */
static double immersion(const gm_description *d, const gm_wheel *wheel)
{
    double tip =
        pitch_radius(wheel) + wheel->normal_module * (1.0 + wheel->profile_shift);
    double depth = d->oil.level - (d->shafts[wheel->shaft].z - tip);
    return wheel->planets > 0 || isnan(depth) ? 0.0 : fmax(depth, 0.0);
}

static gm_dip dip_of(const gm_description *d, const gm_wheel *wheel)
{
    double R_p = pitch_radius(wheel);
    return (gm_dip){.R_p = R_p,
                    .b = wheel->width,
                    .h = immersion(d, wheel),
                    .V_0 = d->oil.volume,
                    .R_a = R_p + wheel->normal_module * (1.0 + wheel->profile_shift),
                    .m_t = wheel->normal_module / cos(wheel->helix),
                    .beta = fabs(wheel->helix)};
}

static gm_drag_element *add_wheel_drag(gm_gearset *gearset, int w, gm_loss_kind kind,
                                       gm_drag_law law)
{
    gm_drag_element *drag = &gearset->drags[gearset->n_drags++];
    *drag = (gm_drag_element){.kind = kind,
                              .name = gearset->description->wheels[w].id.name,
                              .body = gearset->wheel_body[w],
                              .on = GM_HOUSING,
                              .position = gearset->description->wheels[w].position,
                              .law = law};
    return drag;
}

/* Churning of single gears; ISO/TR 14179-2 looks at meshes. */
static void add_churning(gm_gearset *gearset)
{
    const gm_description *d = gearset->description;
    for (int w = 0; w < d->n_wheels; w++) {
        gm_churning_model model = d->wheels[w].churning;
        gm_dip dip = dip_of(d, &d->wheels[w]);
        if (dip.h > 0.0 && model == GM_CHURNING_CHANGENET_VELEX)
            add_wheel_drag(gearset, w, GM_LOSS_CHURNING, GM_DRAG_CHURNING)->dip = dip;
        if (dip.h > 0.0 && model == GM_CHURNING_ISO14179_1)
            add_wheel_drag(gearset, w, GM_LOSS_CHURNING, GM_DRAG_CHURNING_ISO14179_1)
                ->dip = dip;
    }
}

static double splash_depth(const gm_description *d, int wheel)
{
    const gm_wheel *w = &d->wheels[wheel];
    return w->churning == GM_CHURNING_ISO14179_2 ? immersion(d, w) : 0.0;
}

static void add_splashing(gm_gearset *gearset)
{
    const gm_description *d = gearset->description;
    for (int m = 0; m < d->n_meshes; m++) {
        const gm_mesh *mesh = &d->meshes[m];
        const gm_pair *pair = &gearset->meshes[m].pair;
        double depth = splash_depth(d, mesh->wheel[0]) + splash_depth(d, mesh->wheel[1]);
        int pinion = pair->d_w[0] <= pair->d_w[1] ? 0 : 1;
        if (!(depth > 0.0))
            continue;
        gm_drag_element *drag = add_wheel_drag(gearset, mesh->wheel[pinion],
                                               GM_LOSS_CHURNING, GM_DRAG_SPLASH);
        drag->name = mesh->id.name;
        drag->splash = (gm_splash){.depth = depth,
                                   .b = pair->b,
                                   .r_w = 0.5 * pair->d_w[pinion],
                                   .guidance = 1.0};
    }
}

static void add_windage(gm_gearset *gearset)
{
    const gm_description *d = gearset->description;
    for (int w = 0; w < d->n_wheels; w++)
        if (d->wheels[w].windage)
            add_wheel_drag(gearset, w, GM_LOSS_WINDAGE, GM_DRAG_WINDAGE)->windage =
                (gm_windage){.d = 2.0 * pitch_radius(&d->wheels[w]),
                             .b = d->wheels[w].width,
                             .m_n = d->wheels[w].normal_module};
}

static void add_jets(gm_gearset *gearset)
{
    const gm_description *d = gearset->description;
    for (int i = 0; i < d->n_jets; i++) {
        const gm_jet *jet = &d->jets[i];
        gm_drag_element *drag =
            add_wheel_drag(gearset, jet->wheel, GM_LOSS_JET, GM_DRAG_JET);
        drag->name = jet->id.name;
        drag->jet = (gm_jet_law){.radius = pitch_radius(&d->wheels[jet->wheel]),
                                 .flow = jet->flow,
                                 .speed = jet->speed,
                                 .factor = jet->factor};
    }
}

gm_status gm_drags_make(gm_gearset *gearset, gm_error *error)
{
    const gm_description *d = gearset->description;
    /* a gear has at most churning and windage */
    int n = d->n_seals + d->n_gaps + d->n_clutches + 2 * d->n_wheels + d->n_meshes +
            d->n_jets;
    for (int i = 0; i < d->n_synchronisers; i++)
        n += d->synchronisers[i].n_wheels;
    gearset->drags = gm_calloc((size_t)n, sizeof *gearset->drags);
    if (!gearset->drags)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    add_seals_and_gaps(gearset);
    add_cones(gearset);
    add_clutches(gearset);
    add_churning(gearset);
    add_splashing(gearset);
    add_windage(gearset);
    add_jets(gearset);
    return GM_OK;
}
